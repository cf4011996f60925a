#include "compiler/layer_output.h"

#include <string>

#include "slicer/formats/panel.h"

namespace lamina::compiler {
namespace {

using slicer::OutputFormat;

// What the request promises of the contours.
std::optional<slicer::Deviation> promised_deviation(const Request& request) {
  auto deviation = slicer::promised_deviation(request.settings);
  if (deviation && request.chordal_error > 0) {
    deviation->facets = request.chordal_error;
  }
  return deviation;
}

// The panel of the printer; of formats without images an empty one.
slicer::Panel chosen_panel(const Request& request, const FileAccess& access) {
  if (!slicer::is_of_images(request.format)) return {};
  const std::string usual = request.format == OutputFormat::kSl1 ? "prusa-sl1"
                            : request.format == OutputFormat::kNanoDlp
                                ? "wanhao-d7"
                                : "plain";
  slicer::Panel panel = slicer::find_panel(
      request.printer.empty() ? usual : request.printer, access);
  if (request.mirrors_x) panel.right = -panel.right;
  if (request.mirrors_y) panel.up = -panel.up;
  return panel;
}

}  // namespace

LayerOutput::LayerOutput(const Request& request,
                         TemporaryFiles& temporary_files)
    : deviation_(promised_deviation(request)) {
  slicer::WriterOptions options;
  options.format = request.format;
  if (request.cli_encoding) options.cli = *request.cli_encoding;
  options.panel = chosen_panel(request, temporary_files.file_access());
  if (deviation_) options.deviation = deviation_->from_section();
  writer_ = slicer::make_layer_writer(options, request.output, temporary_files);
}

void LayerOutput::finish(Diagnostics& diagnostics, Report& report) {
  writer_->finish(diagnostics);
  if (deviation_) deviation_->rounding = writer_->greatest_rounding();
  report.deviation = deviation_;
  report.snapped_layers = writer_->snapped_layers();
  writer_->commit();
  report.output_bytes = writer_->size();
}

}  // namespace lamina::compiler
