#include "cli/options/contradictions.h"

#include <fmt/format.h>

#include "cli/process/exit_status.h"
#include "compiler/imported_design.h"
#include "slicer/formats/layer_reader.h"
#include "slicer/formats/output_format.h"

namespace lamina::cli {
namespace {

// Null if they go together.
const char* find_contradiction(const slicer::Settings& settings) {
  const bool is_paper = settings.contour == slicer::ContourMode::kPaper;
  if (settings.min_feature > 0 && is_paper) {
    return "--min-feature needs --contour faithful";
  }
  if (settings.paper.boxes == ldni::BoxMode::kGlobal && !is_paper) {
    return "--boxes global needs --contour paper";
  }
  const bool is_adaptive = settings.cusp > 0;
  if (is_adaptive && !settings.heights.empty()) {
    return "--adaptive and --heights say different things";
  }
  if (settings.greatest_thickness > 0 && !is_adaptive) {
    return "--max-layer needs --adaptive";
  }
  if (is_adaptive && settings.greatest_thickness > 0 &&
      settings.greatest_thickness < settings.layer_thickness) {
    return "--max-layer must not be less than --layer";
  }
  if (settings.paper.sampler == ldni::SamplerKind::kScanline) return nullptr;
  if (!is_paper) return "--sampler gl and gl-peeling need --contour paper";
  if (is_adaptive || !settings.heights.empty()) {
    return "--sampler gl and gl-peeling need layers of one thickness, not "
           "--heights or --adaptive";
  }
  return nullptr;
}

const char* find_misfit(const compiler::Request& request, bool has_report) {
  using enum slicer::OutputFormat;
  const slicer::OutputFormat format = request.format;
  const slicer::Settings& settings = request.settings;
  const bool has_layers = slicer::is_of_layers(format);
  if (!has_layers && has_report) return "--report needs layers";
  if (!has_layers && settings.min_feature > 0) {
    return "--min-feature needs layers";
  }
  const bool has_images = slicer::is_of_images(format);
  const bool is_mirrored = request.mirrors_x || request.mirrors_y;
  if (!has_images && !request.printer.empty()) {
    return "--printer needs images: .png, .sl1 or .zip";
  }
  if (!has_images && is_mirrored) {
    return "--mirror needs images: .png, .sl1 or .zip";
  }
  if (request.cli_encoding && format != kCli) return "--cli needs .cli output";
  const bool is_archive = format == kSl1 || format == kNanoDlp;
  if (is_archive && (settings.cusp > 0 || !settings.heights.empty())) {
    return ".sl1 and .zip need layers of one thickness, not --heights or "
           "--adaptive";
  }
  if (format == kThreemf && !settings.heights.empty()) {
    return ".3mf needs layers, not --heights";
  }
  return nullptr;
}

}  // namespace

void refuse_contradictions(const slicer::Settings& settings) {
  if (const char* words = find_contradiction(settings)) throw UsageError(words);
}

void refuse_misfits(const compiler::Request& request, bool has_report) {
  if (const char* words = find_misfit(request, has_report)) {
    throw UsageError(words);
  }
}

void require_readable(std::string_view command, const std::string& file) {
  if (!slicer::is_named_as_layers(file) ||
      slicer::is_readable_layer_file(file) || compiler::is_imported(file)) {
    return;
  }
  throw UsageError(
      fmt::format("{} reads .slc, .cli, .svg and .layers.json, designs and "
                  "meshes; not '{}'",
                  command, file));
}

}  // namespace lamina::cli
