// lamina plate: many pieces on the plates of a printer.

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/paths.h"
#include "base/text.h"
#include "cli/commands/commands.h"
#include "cli/options/design_options.h"
#include "cli/options/option_values.h"
#include "cli/options/output_pattern.h"
#include "cli/pieces/orders.h"
#include "cli/process/exit_status.h"
#include "cli/process/streams.h"
#include "cli/report/finding_table.h"
#include "cli/report/run_report.h"
#include "cli/report/session.h"
#include "compiler/compile.h"
#include "compiler/machine.h"
#include "compiler/stage_text.h"
#include "compiler/tasks/plates.h"
#include "compiler/validate.h"
#include "slicer/plate/footprint.h"
#include "slicer/plate/packer.h"
#include "slicer/plate/plate_map.h"

namespace lamina::cli {
namespace {

using Json = nlohmann::json;

constexpr std::string_view kPlateHelp =
    R"(Usage: lamina plate [DESIGN...] [--table ORDERS.csv] -o PATTERN [OPTION]...

Lays pieces on the plate of a printer, as many plates as they need, and writes
each plate. Every design is sliced once, however many copies of it there are.
Pieces of like height share a plate: the highest decides how long it takes.

  --table ORDERS  a row for each order: columns design, quantity, material and
                  name; all others are variables of the design. Pieces of
                  different materials lie on different plates
  --copies N      of each DESIGN, where there is no table [1]
  -o PATTERN      the plates, such as 'plate-{plate}.sl1'
  --gap MM        least distance between two pieces [2]
  --margin MM     least distance to the edge of the plate [1]
  --turns N       turns about z that are tried, 1 to 36 [8]
  --plate W,D     the plate's size in mm, where no printer is named
  --label         engrave each piece's name in the raft of its supports, which
                  --supports=medium,raft has: 0.4 mm deep, letters 2 mm high
  --map FILE      which piece lies where: a page (.html), or JSON (.json)
  --strict        write nothing if a piece has a warning
  --fail-on KINDS write nothing if a piece has islands, loose-parts, overhangs,
                  suction-cups, resin-traps or all of them
  -q, --quiet     print errors only
  -h, --help      print this help

All other options of Output, Design and Slicing are those of 'lamina --help' and
go for all pieces: --printer, --supports, --hollow, --layer.
)";

// A piece as large as the printer builds fits, whatever rounding its numbers
// saw [mm].
constexpr double kSlack = 1e-6;

// Of plates and gaps: no printer's plate is wider [mm].
constexpr double kGreatestPlateLength = 10000;

// Pieces are equal where these are.
using PieceKey = std::tuple<std::string, std::string, std::string, std::string>;

PieceKey key_of(const compiler::Request& request) {
  return {request.design.path, request.design.definitions,
          request.output.material, request.raft_label};
}

// What is sliced once.
struct PlatePiece {
  compiler::Request request;
  std::string name;
  std::size_t quantity = 0;
};

// What is written of a plate.
struct PlannedPlate {
  compiler::Request request;
  slicer::MappedPlate mapped;
};

class PlateCommand : public Command {
 public:
  std::string_view help() const override { return kPlateHelp; }

  void add_options(OptionList& options) override {
    options.words("design", from_.designs);
    options.name("--table", "file", from_.table);
    options.whole("--copies", from_.copies, 1, 100000);
    options.name("-o", "pattern", request_.output.path).required();
    options.text("--gap", "length", [this](const std::string& text) {
      plate_.gap = length_of("--gap", text);
    });
    options.text("--margin", "length", [this](const std::string& text) {
      plate_.margin = length_of("--margin", text);
    });
    options.whole("--turns", turns_, 1, 36);
    options.text("--plate", "size", [this](const std::string& text) {
      plate_.size = size_of(text);
    });
    options.flag("--label", has_labels_);
    options.name("--map", "file", map_);
    add_output_options(options, request_, output_options_);
    add_design_options(options, request_, is_quiet_);
    add_slicing_options(options, request_);
  }

  bool takes_settings() const override { return true; }

  void check() override {
    cli::check(from_, "plate");
    request_.design.path = from_.designs.empty() ? "" : from_.designs.front();
    refuse_if(request_.output.printer.empty() && plate_.size.x == 0,
              "plate needs --printer, or the plate's size as --plate W,D");
    refuse_if(request_.job.cusp > 0 || !request_.job.heights.empty(),
              "plates have layers of one thickness");
    require_page_or_json("--map", map_);
    refuse_if(!output_options_.report.empty(),
              "the report of plates is --map FILE.json");
    refuse_if(request_.job.written != slicer::LayerNumbers(),
              "plates have all layers: --layers cannot be");
    refuse_words_of_pattern();
    if (turns_) plate_.turns = *turns_;
    request_.output.path = with_extension(request_, output_options_);
    choose_format(request_, output_options_, request_.output.path);
    refuse_if(!slicer::is_of_layers(request_.output.format),
              "plates are layers; '{}' is none", request_.output.path);
    request_.geometry.is_placed_on_bed = true;
    // Each piece gets its own.
    if (has_labels_) request_.raft_label = "name";
    compiler::validate(request_);
  }

  int run(const Context& context) override {
    Terminal terminal(is_quiet_);
    SourceStore sources;
    Diagnostics diagnostics([&](const Diagnostic& d) { terminal.show(d); });
    return run_caught(terminal, {&diagnostics}, [&] {
      const std::vector<PlatePiece> pieces =
          find_pieces(context, sources, diagnostics);
      if (diagnostics.has_errors()) return kFault;
      take_machine(context);
      if (!slice_all(pieces, context)) return kFault;
      return lay_out(pieces, context, terminal, diagnostics);
    });
  }

 private:
  static double length_of(const std::string& option, const std::string& text) {
    const auto length = parse_number(text);
    require(length && *length >= 0 && *length <= kGreatestPlateLength, option,
            "a length from 0 to {:g} mm was expected, not '{}'",
            kGreatestPlateLength, text);
    return *length;
  }

  static Vec2 size_of(const std::string& text) {
    const std::size_t comma = text.find(',');
    const auto width = parse_number(text.substr(0, comma));
    const auto depth = comma == std::string::npos
                           ? std::nullopt
                           : parse_number(text.substr(comma + 1));
    require(width && depth && *width > 0 && *depth > 0 &&
                std::max(*width, *depth) <= kGreatestPlateLength,
            "--plate",
            "a width and a depth were expected, such as 120,68, not '{}'",
            text);
    return {*width, *depth};
  }

  void refuse_words_of_pattern() const {
    std::vector<std::string> words;
    try {
      words = words_of_pattern(request_.output.path);
    } catch (const FileError& error) {
      throw RequestError(error.what());
    }
    for (const std::string& word : words) {
      refuse_if(word != "plate", "'{{{}}}' in -o: plates have {{plate}} alone",
                word);
    }
  }

  // Orders of equal pieces are one.
  std::vector<PlatePiece> find_pieces(const Context& context,
                                      SourceStore& sources,
                                      Diagnostics& diagnostics) const {
    std::vector<PlatePiece> pieces;
    std::map<PieceKey, std::size_t> known;
    for (Order& order : read_orders(from_, request_, context.file_access(),
                                    sources, diagnostics)) {
      if (has_labels_) order.request.raft_label = on_one_line(order.name);
      const auto [at, is_new] =
          known.try_emplace(key_of(order.request), pieces.size());
      if (is_new) pieces.push_back({order.request, order.name, 0});
      pieces[at->second].quantity += order.quantity;
    }
    std::erase_if(pieces,
                  [](const PlatePiece& piece) { return piece.quantity == 0; });
    if (pieces.empty() && !diagnostics.has_errors()) {
      diagnostics.error({},
                        fmt::format("'{}' orders nothing: all quantities are 0",
                                    from_.table));
    }
    return pieces;
  }

  // The plate's size where it is not given, and the greatest height.
  void take_machine(const Context& context) {
    if (request_.output.printer.empty()) return;
    const slicer::Machine machine =
        compiler::choose_machine(request_.output, context.file_access());
    const Vec3 built = machine.printer->build_volume();
    height_ = built.z + kSlack;
    if (plate_.size.x == 0) plate_.size = Vec2(built);
    refuse_if(
        plate_.size.x > built.x + kSlack || plate_.size.y > built.y + kSlack,
        "--plate {:g},{:g} is larger than what {} builds, {:g} x {:g} mm",
        plate_.size.x, plate_.size.y, machine.printer->title, built.x, built.y);
  }

  // Returns whether all went well. Messages begin with the piece's name.
  bool slice_all(const std::vector<PlatePiece>& pieces,
                 const Context& context) {
    context.watch.time_parts();
    bool is_well = true;
    for (const PlatePiece& piece : pieces) {
      Inbox inbox;
      inbox.prefix = on_one_line(piece.name) + ": ";
      inbox.has_progress = true;
      const ProcessWatch::Part timed(context.watch, inbox.prefix);
      is_well &= slice_piece(piece, context, inbox);
      print_messages(inbox.text);
    }
    return is_well;
  }

  bool slice_piece(const PlatePiece& piece, const Context& context,
                   Inbox& inbox) {
    Session session(piece.request, is_quiet_, context, &inbox);
    const int status = session.run([&] {
      auto plated = compiler::slice_for_plates(session.compilation);
      if (!plated) return kFault;
      layers_.push_back(std::move(plated->layers));
      slices_.push_back(std::move(plated->slice));
      return kDone;
    });
    if (status != kDone) return false;
    if (piece.request.job.min_feature > 0) {
      session.terminal.say(feature_lines(session.compilation));
    }
    if (session.compilation.report.direction) {
      session.terminal.say(direction_line(session.compilation.report));
    }
    const auto& print = slices_.back().print;
    if (print && !print->counts(slicer::kAllFindings).empty()) {
      session.terminal.say(fmt::format("print: {}", finding_counts(*print)));
    }
    return true;
  }

  int lay_out(const std::vector<PlatePiece>& pieces, const Context& context,
              Terminal& terminal, Diagnostics& diagnostics) {
    std::vector<slicer::MappedPiece> mapped;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      mapped.push_back({pieces[i].name, slicer::footprint_of(layers_[i])});
    }
    terminal.progress().say("laying out");
    std::vector<PlannedPlate> plates =
        plan_plates(pieces, mapped, context, diagnostics);
    terminal.progress().erase();
    if (diagnostics.has_errors()) return kFault;
    refuse_equal_names(plates);
    // Nothing is written until all is known to fit.
    for (const PlannedPlate& plate : plates) {
      context.expect_outputs({plate.request.output.path});
    }
    context.expect_outputs({map_});
    make_folder_of(map_, context.file_access());
    std::vector<slicer::MappedPlate> titled;
    Json listed = Json::array();
    for (PlannedPlate& plate : plates) {
      const compiler::Report report = write(plate, context, diagnostics);
      plate.mapped.title = title_of(plate, report);
      terminal.say(plate.mapped.title);
      listed.push_back(json_of(plate, report, mapped));
      titled.push_back(std::move(plate.mapped));
    }
    write_map(mapped, titled, listed, context);
    return kDone;
  }

  // What does not fit, and what strict runs refuse, is an error in
  // `diagnostics`.
  std::vector<PlannedPlate> plan_plates(
      const std::vector<PlatePiece>& pieces,
      const std::vector<slicer::MappedPiece>& mapped, const Context& context,
      Diagnostics& diagnostics) const {
    std::map<std::string, std::vector<std::size_t>> by_material;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      by_material[pieces[i].request.output.material].push_back(i);
    }
    std::vector<PlannedPlate> plates;
    for (const auto& [material, own] : by_material) {
      const compiler::Request& request = pieces[own.front()].request;
      compiler::warn_of_plates(request, context.file_access(), diagnostics);
      const slicer::PlatePlan plan = plan_of(pieces, own, mapped);
      refuse_too_large(pieces, own, plan, diagnostics);
      const std::size_t first = plates.size();
      for (std::size_t i = 0; i < plan.plates; ++i) {
        plates.push_back({request, {}});
        plates.back().request.output.path = path_of(plates.size());
      }
      for (slicer::Placement placement : plan.placements) {
        placement.piece = own[placement.piece];
        plates[first + placement.plate].mapped.placements.push_back(placement);
      }
    }
    const bool is_strict =
        request_.output.is_strict.value_or(context.file_access().is_confined());
    if (is_strict) compiler::has_refused_warnings(diagnostics);
    return plates;
  }

  void refuse_too_large(const std::vector<PlatePiece>& pieces,
                        const std::vector<std::size_t>& own,
                        const slicer::PlatePlan& plan,
                        Diagnostics& diagnostics) const {
    for (const std::size_t i : plan.too_large) {
      diagnostics.error(
          {}, fmt::format("{} does not fit a plate of {:g} x {:g} mm",
                          on_one_line(pieces[own[i]].name), plate_.size.x,
                          plate_.size.y));
    }
    for (const std::size_t i : own) {
      const double height = layers_[i].back().top;
      if (height <= height_) continue;
      diagnostics.error(
          {},
          fmt::format("{} is {:g} mm high, the printer builds {:g} mm",
                      on_one_line(pieces[i].name), height, height_ - kSlack));
    }
  }

  void refuse_equal_names(const std::vector<PlannedPlate>& plates) const {
    std::set<std::string> names;
    for (const PlannedPlate& plate : plates) {
      const std::string& path = plate.request.output.path;
      refuse_if(!names.insert(path).second,
                "there are {} plates: -o needs {{plate}}, as in "
                "'plate-{{plate}}.sl1'",
                plates.size());
      refuse_if(path == map_, "-o and --map would both write '{}'", path);
    }
  }

  slicer::PlatePlan plan_of(
      const std::vector<PlatePiece>& pieces,
      const std::vector<std::size_t>& own,
      const std::vector<slicer::MappedPiece>& mapped) const {
    std::vector<slicer::Piece> packed;
    for (const std::size_t i : own) {
      packed.push_back(
          {mapped[i].footprint, layers_[i].back().top, pieces[i].quantity});
    }
    return slicer::pack_plates(packed, plate_);
  }

  compiler::Report write(const PlannedPlate& plate, const Context& context,
                         Diagnostics& diagnostics) const {
    make_folder_of(plate.request.output.path, context.file_access());
    return compiler::write_plate(plate.request, layers_, slices_,
                                 plate.mapped.placements,
                                 context.temporary_files, diagnostics);
  }

  // number  from 1
  std::string path_of(std::size_t number) const {
    return fill_pattern(request_.output.path, [&](const std::string& /*word*/) {
      return fmt::format("{}", number);
    });
  }

  // "plate-1.sl1: 12 pieces, 240 layers, 3.1 ml of resin, 2 h 10 min"
  static std::string title_of(const PlannedPlate& plate,
                              const compiler::Report& report) {
    const std::string estimate =
        slicer::estimate_text(report.machine, report.estimate);
    return fmt::format("{}: {}, {}{}{}",
                       display_path(plate.request.output.path),
                       counted(plate.mapped.placements.size(), "piece"),
                       counted(report.slice.layers, "layer"),
                       estimate.empty() ? "" : ", ", estimate);
  }

  static Json json_of(const PlannedPlate& plate, const compiler::Report& report,
                      const std::vector<slicer::MappedPiece>& mapped) {
    Json pieces = Json::array();
    for (const slicer::Placement& placement : plate.mapped.placements) {
      pieces.push_back({{"name", mapped[placement.piece].name},
                        {"turn_deg", placement.turn_deg},
                        {"x_mm", placement.shift.x},
                        {"y_mm", placement.shift.y}});
    }
    return {{"output", plate.request.output.path},
            {"layers", report.slice.layers},
            {"volume_mm3", report.slice.volume},
            {"seconds", report.estimate.seconds},
            {"grams", report.estimate.grams},
            {"pieces", std::move(pieces)}};
  }

  void write_map(const std::vector<slicer::MappedPiece>& mapped,
                 const std::vector<slicer::MappedPlate>& plates,
                 const Json& listed, const Context& context) const {
    if (map_.empty()) return;
    compiler::write_file(map_,
                         map_.ends_with(".json")
                             ? json_text(listed)
                             : slicer::plate_page(mapped, plates, plate_.size),
                         context.temporary_files);
  }

  OrderSources from_;
  std::optional<unsigned> turns_;
  slicer::Plate plate_ = {.gap = 2, .margin = 1};
  std::string map_;
  bool has_labels_ = false;
  double height_ = std::numeric_limits<double>::infinity();  // [mm]
  compiler::Request request_;
  OutputOptions output_options_;
  bool is_quiet_ = false;
  // Of each piece.
  std::vector<std::vector<slicer::Layer>> layers_;
  std::vector<slicer::SliceReport> slices_;
};

}  // namespace

std::unique_ptr<Command> make_plate_command() {
  return std::make_unique<PlateCommand>();
}

}  // namespace lamina::cli
