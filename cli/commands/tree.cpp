// lamina tree: pieces on the trunk of a casting tree.

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/paths.h"
#include "base/text.h"
#include "cli/commands/commands.h"
#include "cli/options/design_options.h"
#include "cli/options/option_values.h"
#include "cli/options/output_pattern.h"
#include "cli/pieces/orders.h"
#include "cli/process/exit_status.h"
#include "cli/process/streams.h"
#include "cli/report/session.h"
#include "compiler/machine.h"
#include "compiler/stage_text.h"
#include "compiler/tasks/trees.h"
#include "compiler/validate.h"

namespace lamina::cli {
namespace {

constexpr std::string_view kTreeHelp =
    R"(Usage: lamina tree [DESIGN...] [--table ORDERS.csv] --flask D,H -o TREE.scad
                   [OPTION]...

Sets pieces on the trunk of a casting tree, each on the sprues that 'lamina
sprue' would give it, heavy ones near the foot, and writes the tree as an
OpenSCAD design: a line for each piece, which you can move or leave out. Slice
it like any design. What does not fit one flask goes into the next.

  --table ORDERS  a row for each order: columns design, quantity and name; all
                  others are variables of the design
  --copies N      of each DESIGN, where there is no table [1]
  --flask D,H     the flask's diameter and height inside, in mm
  -o PATTERN      the trees; of several 'tree-{tree}.scad'
  --gap MM        least distance between pieces, and to the trunk [3]
  --wall MM       least distance from pieces to the flask's wall [10]
  --trunk MM      the trunk's diameter; it is not thinner than what it feeds [8]
  --sprue         sizes of sprues, as of 'lamina sprue': =D,LENGTH
  --metal METAL   says what each tree weighs
  -q, --quiet     print errors only
  -h, --help      print this help

All options of Design are those of 'lamina --help' and go for all pieces.
)";

// Of flasks, gaps and trunks [mm].
constexpr double kGreatestFlaskLength = 1000;

class TreeCommand : public Command {
 public:
  std::string_view help() const override { return kTreeHelp; }

  void add_options(OptionList& options) override {
    request_.sprues.emplace();
    options.words("design", from_.designs);
    options.name("--table", "file", from_.table);
    options.whole("--copies", from_.copies, 1, 10000);
    options
        .text("--flask", "size",
              [this](const std::string& text) { take_flask(text); })
        .required();
    options.name("-o", "pattern", output_).required();
    add_length(options, "--gap", sizes_.gap);
    add_length(options, "--wall", sizes_.wall);
    add_length(options, "--trunk", sizes_.trunk);
    options.name("--metal", "metal", metals_.metal);
    add_design_options(options, request_, is_quiet_);
    add_facet_options(options, request_);
    add_sprue_option(options, request_);
  }

  void check() override {
    cli::check(from_, "tree");
    refuse_if(!output_.ends_with(".scad"),
              "tree writes a .scad design, but '{}' does not end in .scad",
              output_);
    for (const std::string& word : words_in(output_)) {
      refuse_if(word != "tree", "'{{{}}}' in -o: trees have {{tree}} alone",
                word);
    }
    refuse_if(sizes_.flask_diameter / 2 <=
                      sizes_.wall + sizes_.trunk / 2 + sizes_.gap ||
                  sizes_.flask_height <= sizes_.top + sizes_.foot,
              "--flask {:g},{:g} leaves no room for pieces: walls take {:g} "
              "mm, the ends {:g} mm",
              sizes_.flask_diameter, sizes_.flask_height, sizes_.wall,
              sizes_.top + sizes_.foot);
    request_.design.path = from_.designs.empty() ? "" : from_.designs.front();
    request_.output.format = slicer::OutputFormat::kCsg;
    request_.output.path = output_;
    compiler::validate(request_);
  }

  int run(const Context& context) override {
    Terminal terminal(is_quiet_);
    SourceStore sources;
    Diagnostics diagnostics([&](const Diagnostic& d) { terminal.show(d); });
    return run_caught(terminal, {&diagnostics}, [&] {
      metal_ = compiler::choose_machine(metals_, context.file_access()).metal;
      std::vector<std::size_t> wanted =
          make_parts(context, sources, diagnostics);
      if (diagnostics.has_errors() || has_failed_) return kFault;
      return plant_all(std::move(wanted), context, terminal, diagnostics);
    });
  }

 private:
  static void add_length(OptionList& options, const std::string& option,
                         double& length) {
    options.text(option, "length", [&length, option](const std::string& text) {
      const auto value = parse_number(text);
      require(value && *value > 0 && *value <= kGreatestFlaskLength, option,
              "a length of more than 0 and at most {:g} mm was expected, not "
              "'{}'",
              kGreatestFlaskLength, text);
      length = *value;
    });
  }

  void take_flask(const std::string& text) {
    const auto numbers = require_numbers("--flask", text);
    require(numbers.size() == 2 && numbers[0] > 0 && numbers[1] > 0 &&
                numbers[0] <= kGreatestFlaskLength &&
                numbers[1] <= kGreatestFlaskLength,
            "--flask",
            "a diameter and a height in mm were expected, such as 80,100, not "
            "'{}'",
            text);
    sizes_.flask_diameter = numbers[0];
    sizes_.flask_height = numbers[1];
  }

  static std::vector<std::string> words_in(const std::string& pattern) {
    try {
      return words_of_pattern(pattern);
    } catch (const FileError& error) {
      throw RequestError(error.what());
    }
  }

  // Makes each part once; returns the part of each piece.
  std::vector<std::size_t> make_parts(const Context& context,
                                      SourceStore& sources,
                                      Diagnostics& diagnostics) {
    std::vector<std::size_t> wanted;
    std::map<std::pair<std::string, std::string>, std::size_t> known;
    for (const Order& order : read_orders(
             from_, request_, context.file_access(), sources, diagnostics)) {
      const compiler::DesignRequest& design = order.request.design;
      const auto [at, is_new] =
          known.try_emplace({design.path, design.definitions}, parts_.size());
      if (is_new) make_part(order, context);
      wanted.insert(wanted.end(), order.quantity, at->second);
    }
    return wanted;
  }

  // Messages begin with the piece's name.
  void make_part(const Order& order, const Context& context) {
    Inbox inbox;
    inbox.prefix = on_one_line(order.name) + ": ";
    inbox.has_progress = true;
    Session session(order.request, is_quiet_, context, &inbox);
    const int status = session.run([&] {
      auto part = compiler::make_tree_part(session.compilation);
      if (!part) return kFault;
      parts_.push_back(std::move(*part));
      names_.push_back(order.name);
      sizes_.trunk = std::max(sizes_.trunk, parts_.back().shape.root_diameter);
      return kDone;
    });
    has_failed_ |= status != kDone;
    print_messages(inbox.text);
  }

  int plant_all(std::vector<std::size_t> wanted, const Context& context,
                Terminal& terminal, Diagnostics& diagnostics) {
    terminal.progress().say("planting");
    std::vector<slicer::TreePiece> shapes;
    for (const compiler::TreePart& part : parts_) shapes.push_back(part.shape);
    std::vector<slicer::CastingTree> trees;
    while (!wanted.empty()) {
      trees.push_back(slicer::plant_tree(shapes, wanted, sizes_));
      if (!trees.back().placements.empty()) continue;
      for (const std::size_t part : wanted) unplanted_.insert(part);
      break;
    }
    terminal.progress().erase();
    for (const std::size_t part : unplanted_) {
      diagnostics.error(
          {}, fmt::format("{} does not fit a flask {:g} mm wide and {:g} mm "
                          "high: {:g} mm of wall and {:g} mm of gap are kept",
                          on_one_line(names_[part]), sizes_.flask_diameter,
                          sizes_.flask_height, sizes_.wall, sizes_.gap));
    }
    refuse_if(
        trees.size() > 1 && words_in(output_).empty(),
        "there are {} trees: -o needs {{tree}}, as in 'tree-{{tree}}.scad'",
        trees.size());
    if (diagnostics.has_errors()) return kFault;
    for (std::size_t i = 0; i < trees.size(); ++i) {
      write(trees[i], path_of(i + 1), context, terminal);
    }
    return kDone;
  }

  std::string path_of(std::size_t number) const {
    return fill_pattern(output_, [&](const std::string& /*word*/) {
      return fmt::format("{}", number);
    });
  }

  void write(const slicer::CastingTree& tree, const std::string& path,
             const Context& context, Terminal& terminal) const {
    context.expect_outputs({path});
    make_folder_of(path, context.file_access());
    compiler::write_file(path,
                         compiler::tree_text(tree, parts_, names_, sizes_),
                         context.temporary_files);
    const double volume = compiler::tree_volume(tree, parts_, sizes_);
    std::string text = fmt::format(
        "{}: {} on a trunk {:g} x {:.0f} mm, {:.4g} mm³ with sprues and trunk",
        on_one_line(path), counted(tree.placements.size(), "piece"),
        sizes_.trunk, tree.trunk_height, volume);
    if (metal_) {
      double pieces = 0;
      for (const auto& placement : tree.placements) {
        pieces += parts_[placement.piece].volume;
      }
      text += fmt::format("; {:.4g} g of {}, {:.4g} g of it pieces",
                          metal_->weight(volume), metal_->title,
                          metal_->weight(pieces));
    }
    terminal.say(text);
  }

  OrderSources from_;
  compiler::OutputRequest metals_;  // its metal
  std::optional<slicer::Material> metal_;
  std::string output_;
  slicer::TreeSizes sizes_;
  compiler::Request request_;
  bool is_quiet_ = false;
  // Of each part.
  std::vector<compiler::TreePart> parts_;
  std::vector<std::string> names_;
  std::set<std::size_t> unplanted_;
  bool has_failed_ = false;
};

}  // namespace

std::unique_ptr<Command> make_tree_command() {
  return std::make_unique<TreeCommand>();
}

}  // namespace lamina::cli
