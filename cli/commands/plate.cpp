// lamina plate: many pieces on the plates of a printer.

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/paths.h"
#include "base/text.h"
#include "cli/commands/commands.h"
#include "cli/commands/orders.h"
#include "cli/options/design_options.h"
#include "cli/options/option_values.h"
#include "cli/options/output_pattern.h"
#include "cli/process/exit_status.h"
#include "cli/process/streams.h"
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

using nlohmann::json;

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
  --map FILE      which piece lies where: a page (.html), or JSON (.json)
  -q, --quiet     print errors only
  -h, --help      print this help

All other options of Output, Design and Slicing are those of 'lamina --help' and
go for all pieces: --printer, --supports, --hollow, --layer.
)";

// Pieces are equal where these are.
using PieceKey = std::tuple<std::string, std::string, std::string>;

PieceKey key_of(const compiler::Request& request) {
  return {request.design.path, request.design.definitions,
          request.output.material};
}

// What is sliced once.
struct PlatePiece {
  compiler::Request request;
  std::string name;
  std::size_t quantity = 0;
};

class PlateCommand : public Command {
 public:
  std::string_view help() const override { return kPlateHelp; }

  void add_options(OptionList& options) override {
    options.words("design", designs_);
    options.name("--table", "file", table_);
    options.whole("--copies", copies_, 1, 100000);
    options.name("-o", "pattern", request_.output.path).required();
    options.number("--gap", "length", plate_.gap);
    options.number("--margin", "length", plate_.margin);
    options.whole("--turns", turns_, 1, 36);
    options.text("--plate", "size", [this](const std::string& text) {
      plate_.size = size_of(text);
    });
    options.name("--map", "file", map_);
    add_machine_options(options, request_);
    add_print_options(options, request_);
    add_design_options(options, request_, is_quiet_);
    add_slicing_options(options, request_);
  }

  bool takes_settings() const override { return true; }

  void check() override {
    refuse_if(designs_.empty() && table_.empty(),
              "plate needs a design or --table");
    refuse_if(designs_.size() > 1 && !table_.empty(),
              "with --table one design at most: that of rows without one");
    refuse_if(copies_ && !table_.empty(),
              "--copies is the table's column 'quantity'");
    refuse_if(request_.output.printer.empty() && plate_.size.x == 0,
              "plate needs --printer, or the plate's size as --plate W,D");
    refuse_if(request_.job.cusp > 0 || !request_.job.heights.empty(),
              "plates have layers of one thickness");
    refuse_if(
        !map_.empty() && !map_.ends_with(".html") && !map_.ends_with(".json"),
        "--map writes .html or .json; '{}' is neither", map_);
    if (turns_) plate_.turns = *turns_;
    const OutputOptions output;
    request_.output.path = with_extension(request_, output);
    choose_format(request_, output, request_.output.path);
    refuse_if(!slicer::is_of_layers(request_.output.format),
              "plates are layers; '{}' is none", request_.output.path);
    request_.geometry.is_placed_on_bed = true;
    request_.design.path = designs_.empty() ? "" : designs_.front();
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
      if (!slice_all(pieces, context)) return kFault;
      return lay_out(pieces, context, terminal, diagnostics);
    });
  }

 private:
  static Vec2 size_of(const std::string& text) {
    const std::size_t comma = text.find(',');
    const auto width = parse_number(text.substr(0, comma));
    const auto depth = comma == std::string::npos
                           ? std::nullopt
                           : parse_number(text.substr(comma + 1));
    require(width && depth && *width > 0 && *depth > 0, "--plate",
            "a width and a depth were expected, such as 120,68, not '{}'",
            text);
    return {*width, *depth};
  }

  std::vector<Order> orders(const Context& context, SourceStore& sources,
                            Diagnostics& diagnostics) const {
    if (!table_.empty()) {
      return read_orders(table_, request_, context.file_access(), sources,
                         diagnostics);
    }
    std::vector<Order> orders;
    for (const std::string& design : designs_) {
      Order& order = orders.emplace_back();
      order.name = stem(design);
      order.request = request_;
      order.request.design.path = design;
      order.quantity = copies_.value_or(1);
    }
    return orders;
  }

  // Orders of equal pieces are one.
  std::vector<PlatePiece> find_pieces(const Context& context,
                                      SourceStore& sources,
                                      Diagnostics& diagnostics) const {
    std::vector<PlatePiece> pieces;
    std::map<PieceKey, std::size_t> known;
    for (const Order& order : orders(context, sources, diagnostics)) {
      const auto [at, is_new] =
          known.try_emplace(key_of(order.request), pieces.size());
      if (is_new) pieces.push_back({order.request, order.name, 0});
      pieces[at->second].quantity += order.quantity;
    }
    std::erase_if(pieces,
                  [](const PlatePiece& piece) { return piece.quantity == 0; });
    return pieces;
  }

  // Returns whether all went well.
  bool slice_all(const std::vector<PlatePiece>& pieces,
                 const Context& context) {
    bool is_well = true;
    for (const PlatePiece& piece : pieces) {
      Inbox inbox;
      inbox.prefix = piece.name + ": ";
      {
        Session session(piece.request, is_quiet_, context, &inbox);
        is_well &= session.run([&] {
          auto plated = compiler::slice_for_plates(session.compilation);
          if (!plated) return kFault;
          layers_.push_back(std::move(plated->layers));
          slices_.push_back(std::move(plated->slice));
          return kDone;
        }) == kDone;
      }
      print_messages(inbox.text);
    }
    return is_well;
  }

  int lay_out(const std::vector<PlatePiece>& pieces, const Context& context,
              Terminal& terminal, Diagnostics& diagnostics) {
    if (plate_.size.x == 0) {
      const slicer::Machine machine =
          compiler::choose_machine(request_.output, context.file_access());
      plate_.size = Vec2(machine.printer->build_volume());
    }
    std::vector<slicer::MappedPiece> mapped;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      mapped.push_back({pieces[i].name, slicer::footprint_of(layers_[i])});
    }
    std::map<std::string, std::vector<std::size_t>> by_material;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      by_material[pieces[i].request.output.material].push_back(i);
    }
    std::vector<slicer::MappedPlate> plates;
    json listed = json::array();
    bool is_well = true;
    for (const auto& [material, own] : by_material) {
      const slicer::PlatePlan plan = plan_of(pieces, own, mapped);
      for (const std::size_t piece : plan.too_large) {
        diagnostics.error(
            {},
            fmt::format("{} does not fit a plate of {:g} x {:g} mm",
                        pieces[own[piece]].name, plate_.size.x, plate_.size.y));
        is_well = false;
      }
      if (!is_well) continue;
      for (std::size_t number = 0; number < plan.plates; ++number) {
        slicer::MappedPlate& plate = plates.emplace_back();
        for (slicer::Placement placement : plan.placements) {
          if (placement.plate != number) continue;
          placement.piece = own[placement.piece];
          plate.placements.push_back(placement);
        }
        compiler::Request request = pieces[own.front()].request;
        request.output.path = path_of(plates.size());
        const compiler::Report report =
            write(request, plate, context, diagnostics);
        plate.title = title_of(request, report, plate);
        terminal.say(plate.title);
        listed.push_back(json_of(request, report, plate, mapped));
      }
    }
    if (!is_well) return kFault;
    refuse_if(plates.size() > 1 && path_of(1) == path_of(2),
              "there are {} plates: -o needs {{plate}}, as in "
              "'plate-{{plate}}.sl1'",
              plates.size());
    write_map(mapped, plates, listed, context);
    return kDone;
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

  compiler::Report write(const compiler::Request& request,
                         const slicer::MappedPlate& plate,
                         const Context& context, Diagnostics& diagnostics) {
    context.expect_outputs({request.output.path});
    return compiler::write_plate(request, layers_, slices_, plate.placements,
                                 context.temporary_files, diagnostics);
  }

  // number  from 1
  std::string path_of(std::size_t number) const {
    return fill_pattern(request_.output.path, [&](const std::string& word) {
      return word == "plate" ? fmt::format("{}", number)
                             : fmt::format("{{{}}}", word);
    });
  }

  // "plate-1.sl1: 12 pieces, 240 layers, 3.1 ml of resin, 2 h 10 min"
  static std::string title_of(const compiler::Request& request,
                              const compiler::Report& report,
                              const slicer::MappedPlate& plate) {
    const std::string estimate =
        slicer::estimate_text(report.machine, report.estimate);
    return fmt::format("{}: {}, {}{}{}", display_path(request.output.path),
                       counted(plate.placements.size(), "piece"),
                       counted(report.slice.layers, "layer"),
                       estimate.empty() ? "" : ", ", estimate);
  }

  static json json_of(const compiler::Request& request,
                      const compiler::Report& report,
                      const slicer::MappedPlate& plate,
                      const std::vector<slicer::MappedPiece>& mapped) {
    json pieces = json::array();
    for (const slicer::Placement& placement : plate.placements) {
      pieces.push_back({{"name", mapped[placement.piece].name},
                        {"turn_deg", placement.turn_deg},
                        {"x_mm", placement.shift.x},
                        {"y_mm", placement.shift.y}});
    }
    return {{"output", request.output.path},
            {"layers", report.slice.layers},
            {"volume_mm3", report.slice.volume},
            {"seconds", report.estimate.seconds},
            {"grams", report.estimate.grams},
            {"pieces", std::move(pieces)}};
  }

  void write_map(const std::vector<slicer::MappedPiece>& mapped,
                 const std::vector<slicer::MappedPlate>& plates,
                 const json& listed, const Context& context) const {
    if (map_.empty()) return;
    context.expect_outputs({map_});
    compiler::write_file(map_,
                         map_.ends_with(".json")
                             ? json_text(listed)
                             : slicer::plate_page(mapped, plates, plate_.size),
                         context.temporary_files);
  }

  std::vector<std::string> designs_;
  std::string table_;
  std::optional<unsigned> copies_;
  std::optional<unsigned> turns_;
  slicer::Plate plate_ = {.gap = 2, .margin = 1};
  std::string map_;
  compiler::Request request_;
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
