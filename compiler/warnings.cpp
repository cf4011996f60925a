#include "compiler/warnings.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/ranges.h>

#include "base/text.h"

namespace lamina::compiler {
namespace {

using slicer::OutputFormat;

// A file without units, or in others, makes pieces a thousand times too small
// or too large.
void warn_of_size(const csg::Lowered& lowered, Diagnostics& diagnostics) {
  constexpr double kSmallest = 0.25;  // mm
  constexpr double kLargest = 5000;
  if (lowered.scene() == nullptr) return;
  const Vec3 size = lowered.scene()->box.size();
  const double greatest = std::max({size.x, size.y, size.z});
  if (greatest >= kSmallest && greatest <= kLargest) return;
  diagnostics.own_warning(
      {}, fmt::format("the design is {:g} x {:g} x {:g} mm: are its units "
                      "millimetres?",
                      size.x, size.y, size.z));
}

// The settings of slicing that an outline has no use for. It keeps all of its
// vertices, as a tolerance of 0 asks.
std::vector<std::string_view> settings_of_solids(const Request& request) {
  const slicer::Settings& settings = request.job;
  const slicer::Settings usual;
  std::vector<std::string_view> all;
  const auto add = [&](std::string_view option, bool is_set) {
    if (is_set) all.push_back(option);
  };
  add("--layer", settings.layer_thickness != usual.layer_thickness);
  add("--adaptive", settings.cusp != usual.cusp);
  add("--heights", !settings.heights.empty());
  add("--axis", request.geometry.axis != Request().geometry.axis);
  add("--turn", request.geometry.turn != 0);
  add("--place-on-bed", request.geometry.is_placed_on_bed);
  add("--tolerance",
      settings.tolerance != usual.tolerance && settings.tolerance != 0);
  add("--ray", settings.ray_pitch != usual.ray_pitch);
  add("--contour", settings.contour != usual.contour);
  return all;
}

void warn_of_settings(const csg::Lowered& lowered, const Request& request,
                      Diagnostics& diagnostics) {
  if (lowered.outline() == nullptr) return;
  const auto settings = settings_of_solids(request);
  if (settings.empty()) return;
  diagnostics.own_warning(
      {}, fmt::format("the design is an outline, of which {} can change "
                      "nothing",
                      fmt::join(settings, ", ")));
}

// Heights in other units, or of a design that was placed elsewhere, would make
// empty layers without a word.
void warn_of_heights(const csg::Lowered& lowered, const Request& request,
                     Diagnostics& diagnostics) {
  const std::vector<double>& heights = request.job.heights;
  if (lowered.scene() == nullptr || heights.empty()) return;
  const Box3& box = lowered.scene()->box;
  if (box.is_empty()) return;
  const auto outside = static_cast<std::size_t>(std::count_if(
      heights.begin(), heights.end(),
      [&box](double z) { return z < box.low.z || z > box.high.z; }));
  if (outside == 0) return;
  diagnostics.own_warning(
      {}, fmt::format("{} of {} outside the design, which reaches from z {:g} "
                      "to {:g} mm",
                      outside, counted(heights.size(), "height"), box.low.z,
                      box.high.z));
}

// A printer that reads one of these formats may not read the other.
void warn_of_panel_file(const slicer::Printer& printer, OutputFormat format,
                        Diagnostics& diagnostics) {
  const bool reads_it =
      std::ranges::any_of(printer.reads, [&](const std::string& extension) {
        return slicer::choose_output_format(extension).format == format;
      });
  if (printer.reads.empty() || reads_it) return;
  diagnostics.own_warning(
      {}, fmt::format("{} reads .{} files; whether it reads this format is "
                      "not known",
                      printer.title, printer.reads.front()));
}

// Prusa's printers alone read the archive as it is.
void warn_of_archive(const Machine& machine, const Request& request,
                     Diagnostics& diagnostics) {
  if (request.output.format == OutputFormat::kGoo ||
      request.output.format == OutputFormat::kCtb) {
    warn_of_panel_file(*machine.printer, request.output.format, diagnostics);
  }
  if (request.output.format != OutputFormat::kSl1) return;
  if (machine.printer->name.starts_with("prusa-sl1")) return;
  diagnostics.own_warning(
      {}, fmt::format("an .sl1 archive for {} is for programs that convert it, "
                      "such as UVtools: the printer does not read it",
                      machine.printer->name));
}

// Exposures hold for a resin, a printer and a thickness.
void warn_of_exposure(const Machine& machine, const Request& request,
                      Diagnostics& diagnostics) {
  if (!machine.printer || !slicer::is_of_images(request.output.format)) return;
  const slicer::ChosenExposure chosen =
      slicer::choose_exposure(machine, request.job.layer_thickness);
  if (!chosen.holds_for.empty()) {
    diagnostics.own_warning(
        {}, fmt::format("the exposure of {} is for {}; a profile of your own "
                        "can have yours",
                        machine.material->title, chosen.holds_for));
  } else if (chosen.is_assumed && request.output.format != OutputFormat::kPng) {
    diagnostics.own_remark(
        {},
        fmt::format("no exposure is known for {}: {:g} s a layer and {:g} s "
                    "for the first are assumed",
                    machine.material ? machine.material->title
                                     : "a resin that --material names",
                    chosen.exposure.layer, chosen.exposure.first));
  }
}

}  // namespace

void warn_of_geometry(const csg::Lowered& lowered, const Request& request,
                      Diagnostics& diagnostics) {
  warn_of_size(lowered, diagnostics);
  warn_of_settings(lowered, request, diagnostics);
  warn_of_heights(lowered, request, diagnostics);
}

void warn_of_machine(const Machine& machine, const Request& request,
                     Diagnostics& diagnostics) {
  warn_of_archive(machine, request, diagnostics);
  warn_of_exposure(machine, request, diagnostics);
}

}  // namespace lamina::compiler
