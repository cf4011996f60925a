// lamina preflight: what a casting house asks before it takes a piece.

#include "compiler/tasks/preflight.h"

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "cli/commands/commands.h"
#include "cli/commands/preflight_page.h"
#include "cli/options/design_options.h"
#include "cli/options/option_values.h"
#include "cli/process/exit_status.h"
#include "cli/process/streams.h"
#include "cli/report/run_report.h"
#include "cli/report/session.h"
#include "compiler/stage_text.h"
#include "compiler/validate.h"

namespace lamina::cli {
namespace {

using nlohmann::ordered_json;

constexpr std::string_view kPreflightHelp =
    R"(Usage: lamina preflight DESIGN --metal METAL [-o FILE] [OPTION]...

Says what a casting house asks of a piece: walls, prongs, gaps and engravings
thinner or shallower than the metal allows, weights, size, ring size, stones, and
heavy places that metal reaches only through thinner ones. Exit status 1 where
something is too thin or too shallow.

  -o FILE             write it as a page of A4 with pictures (.html) or JSON
                      (.json)
  --metal METAL       what it is cast in ('lamina materials')
  --gate X,Y,Z[,MM]   where metal enters, and through what diameter; several may
                      be given [the thickest place]
  -q, --quiet         print errors only
  -h, --help          print this help

All options of Design and Slicing are those of 'lamina --help', but for
--supports, --sprue, --compensate and --heights.
)";

ordered_json json_of(Vec3 place) { return {place.x, place.y, place.z}; }

class PreflightCommand : public Command {
 public:
  std::string_view help() const override { return kPreflightHelp; }

  void add_options(OptionList& options) override {
    options.word("design", request_.design.path).required();
    options.name("-o", "file", output_);
    options.texts("--gate", "place", [this](const std::string& text) {
      const std::vector<double> numbers = require_numbers("--gate", text);
      require(numbers.size() == 3 || (numbers.size() == 4 && numbers[3] > 0),
              "--gate",
              "a place, and a diameter above 0 if you like, were expected, not "
              "'{}'",
              text);
      options_.gates.push_back({Vec3(numbers[0], numbers[1], numbers[2]),
                                numbers.size() == 4 ? numbers[3] : 0});
    });
    add_machine_options(options, request_);
    add_design_options(options, request_, is_quiet_);
    add_slicing_options(options, request_);
    for (const char* name : {"--printer", "--price"}) options.remove(name);
  }

  bool takes_settings() const override { return true; }

  void check() override {
    require_page_or_json("preflight", output_);
    refuse_layers(request_.design.path);
    refuse_if(request_.supports || request_.sprues,
              "preflight looks at the piece without --supports and --sprue");
    refuse_if(!request_.job.heights.empty(),
              "preflight weighs whole layers, not --heights");
    const auto& compensation = request_.compensation;
    refuse_if(compensation.contour || compensation.foot || compensation.bleed,
              "preflight looks at the piece without --compensate");
    compiler::validate(request_);
  }

  int run(const Context& context) override {
    Session session(request_, is_quiet_, context);
    return session.run([&] {
      context.expect_outputs({output_});
      const auto found = compiler::preflight(session.compilation, options_);
      if (!found) return kFault;
      session.terminal.progress().erase();
      const std::string name =
          std::filesystem::path(request_.design.path).filename();
      if (!is_quiet_) print_out(text_of(*found, name));
      if (!output_.empty()) {
        compiler::write_file(output_,
                             output_.ends_with(".json")
                                 ? json_text(json_of(*found))
                                 : preflight_page(*found, request_.design.path),
                             context.temporary_files);
      }
      return found->is_ready() ? kDone : kFault;
    });
  }

 private:
  static std::string text_of(const compiler::Preflight& found,
                             const std::string& name) {
    std::string text =
        fmt::format("{}, cast in {}: {:.2f} g\n", name, found.metal.title,
                    found.metal.weight(found.volume));
    text += fmt::format(
        "  {}, {:.1f} mm³, surface {:.0f} mm², at most {:.2f} "
        "mm thick\n",
        size_text(found.box.size()), found.volume, found.area, found.thickest);
    if (found.finger > 0) {
      text += fmt::format("  inner diameter {:.2f} mm: {}\n", found.finger,
                          ring_size_text(found.finger));
    }
    const auto& metals = found.metals;
    for (std::size_t i = 1; i < metals.size(); ++i) {
      text += fmt::format("{}{} {:.2f} g", i == 1 ? "  in " : ", ",
                          metals[i].title, metals[i].weight(found.volume));
    }
    return text + "\n" + stones_text(found) + thin_text(found) +
           feeding_text(found);
  }

  static std::string stones_text(const compiler::Preflight& found) {
    std::string text;
    for (const compiler::StoneParameter& one : found.stones) {
      const std::string size = stone_text(one);
      text += fmt::format("{}{} = {}{}", text.empty() ? "  stones: " : "; ",
                          one.entry.name, one.entry.value,
                          size.empty() ? "" : " (" + size + ")");
    }
    return text.empty() ? "" : text + "\n";
  }

  static std::string thin_text(const compiler::Preflight& found) {
    const std::string least = least_text(*found.metal.casting);
    if (found.is_ready()) {
      return fmt::format("nothing is too thin or too shallow ({})\n", least);
    }
    std::string text =
        fmt::format("{} (asked for: {}):\n", fault_text(found), least);
    for (std::size_t i = 0; i < found.too_thin.size() && i < kMostRows; ++i) {
      const compiler::TooThin& one = found.too_thin[i];
      text += fmt::format("  {} of {:.2f} mm, {:.2f} mm², at {}: {}\n",
                          kind_of(one), one.place.width, one.place.area,
                          place_text(one.place.place),
                          compiler::text_of(one.lines));
    }
    text += rest_text(found.too_thin.size());
    for (std::size_t i = 0; i < found.too_shallow.size() && i < kMostRows;
         ++i) {
      const auto& [engraving, least_depth, lines] = found.too_shallow[i];
      text +=
          fmt::format("  engraving {:.2f} mm deep, {:.2f} mm wide, at {}: {}\n",
                      engraving.depth, engraving.width,
                      place_text(engraving.place), compiler::text_of(lines));
    }
    return text + rest_text(found.too_shallow.size());
  }

  static std::string feeding_text(const compiler::Preflight& found) {
    std::string gates;
    for (const slicer::Gate& gate : found.gates) {
      gates += (gates.empty() ? "" : " and ") + place_text(gate.place);
    }
    if (found.unfed.empty()) {
      return fmt::format(
          "metal from {} reaches all heavy places through places as thick\n",
          gates);
    }
    std::string text =
        fmt::format("metal from {} reaches {} through thinner ones only:\n",
                    gates, counted(found.unfed.size(), "heavy place"));
    for (std::size_t i = 0; i < found.unfed.size() && i < kMostRows; ++i) {
      const auto& [pool, lines] = found.unfed[i];
      text += fmt::format("  {:.2f} mm, {:.1f} mm³, at {}, ", pool.thickness,
                          pool.volume, place_text(pool.place));
      text += pool.neck_thickness > 0
                  ? fmt::format("through {:.2f} mm: {}\n", pool.neck_thickness,
                                compiler::text_of(lines))
                  : fmt::format("joined to nothing: {}\n",
                                compiler::text_of(lines));
    }
    return text + rest_text(found.unfed.size());
  }

  static std::string rest_text(std::size_t count) {
    return count > kMostRows ? fmt::format("  and {} more\n", count - kMostRows)
                             : "";
  }

  static ordered_json json_of(const compiler::Preflight& found) {
    ordered_json json = {{"metal", found.metal.name},
                         {"grams", found.metal.weight(found.volume)},
                         {"volume_mm3", found.volume},
                         {"surface_mm2", found.area},
                         {"size_mm", cli::json_of(found.box.size())},
                         {"thickest_mm", found.thickest}};
    if (found.finger > 0) {
      json["inner_diameter_mm"] = found.finger;
      json["ring_size_eu"] = compiler::european_ring_size(found.finger);
      json["ring_size_us"] = compiler::american_ring_size(found.finger);
    }
    for (const slicer::Material& metal : found.metals) {
      json["weights_g"][metal.name] = metal.weight(found.volume);
    }
    const slicer::CastingLimits& limits = *found.metal.casting;
    json["asked_for"] = {{"wall_mm", limits.wall},
                         {"wire_mm", limits.wire},
                         {"gap_mm", limits.gap},
                         {"engraving_depth_mm", limits.engraving},
                         {"finishing_mm", limits.finishing},
                         {"source", limits.source}};
    json["edges"] = found.edges;
    json["too_thin"] = ordered_json::array();
    for (const compiler::TooThin& one : found.too_thin) {
      json["too_thin"].push_back({{"kind", kind_of(one)},
                                  {"thickness_mm", one.place.width},
                                  {"least_mm", one.least},
                                  {"area_mm2", one.place.area},
                                  {"place", cli::json_of(one.place.place)},
                                  {"lines", compiler::text_of(one.lines)}});
    }
    json["too_shallow"] = ordered_json::array();
    for (const auto& [engraving, least, lines] : found.too_shallow) {
      json["too_shallow"].push_back({{"depth_mm", engraving.depth},
                                     {"least_mm", least},
                                     {"width_mm", engraving.width},
                                     {"area_mm2", engraving.area},
                                     {"place", cli::json_of(engraving.place)},
                                     {"lines", compiler::text_of(lines)}});
    }
    json["gates"] = ordered_json::array();
    for (const slicer::Gate& gate : found.gates) {
      json["gates"].push_back({{"place", cli::json_of(gate.place)},
                               {"diameter_mm", gate.diameter}});
    }
    json["unfed"] = ordered_json::array();
    for (const auto& [pool, lines] : found.unfed) {
      json["unfed"].push_back({{"thickness_mm", pool.thickness},
                               {"volume_mm3", pool.volume},
                               {"place", cli::json_of(pool.place)},
                               {"neck_mm", pool.neck_thickness},
                               {"neck", cli::json_of(pool.neck)},
                               {"lines", compiler::text_of(lines)}});
    }
    json["stones"] = ordered_json::array();
    for (const compiler::StoneParameter& one : found.stones) {
      ordered_json stone = {{"name", one.entry.name},
                            {"value", one.entry.value}};
      if (one.diameter) {
        stone["diameter_mm"] = *one.diameter;
        stone["carats"] = *one.carats;
      }
      json["stones"].push_back(stone);
    }
    json["parameters"] = ordered_json::object();
    for (const CustomizerEntry& one : found.parameters) {
      json["parameters"][one.name] = one.value;
    }
    json["pitch_mm"] = found.pitch;
    return json;
  }

  compiler::Request request_;
  compiler::PreflightOptions options_;
  std::string output_;
  bool is_quiet_ = false;
};

}  // namespace

std::unique_ptr<Command> make_preflight_command() {
  return std::make_unique<PreflightCommand>();
}

}  // namespace lamina::cli
