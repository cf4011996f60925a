#include "compiler/layer_output.h"

#include <utility>

#include "compiler/passes.h"
#include "compiler/warnings.h"

namespace lamina::compiler {
namespace {

// What the request promises of the contours.
std::optional<slicer::Deviation> promised_deviation(const Request& request,
                                                    const Machine& machine) {
  auto deviation = slicer::promised_deviation(settings_of(request, machine));
  if (deviation && request.geometry.chordal_error > 0) {
    deviation->facets = request.geometry.chordal_error;
  }
  return deviation;
}

}  // namespace

LayerOutput::LayerOutput(const Machine& machine, double layer_thickness,
                         std::optional<slicer::Deviation> deviation,
                         std::unique_ptr<slicer::LayerWriter> writer)
    : machine_(machine),
      layer_thickness_(layer_thickness),
      deviation_(deviation),
      writer_(std::move(writer)) {
  if (machine_.printer) build_volume_.emplace(*machine_.printer, *writer_);
}

LayerOutput LayerOutput::open(const Request& request, const Machine& machine,
                              TemporaryFiles& temporary_files,
                              Diagnostics& diagnostics) {
  warn_of_machine(machine, request, diagnostics);
  if (request.output.format == slicer::OutputFormat::kThreemf) {
    diagnostics.own_remark(
        {}, "programs that know no slices open this 3MF as a box");
  }
  const auto deviation = promised_deviation(request, machine);
  slicer::WriterOptions options;
  options.format = request.output.format;
  if (request.output.cli_encoding) options.cli = *request.output.cli_encoding;
  if (machine.printer) options.printer = *machine.printer;
  options.exposure =
      slicer::choose_exposure(machine, request.job.layer_thickness).exposure;
  if (machine.material) options.material = machine.material->title;
  if (deviation) options.deviation = deviation->from_section();
  auto writer =
      slicer::make_layer_writer(options, request.output.path, temporary_files);
  return {machine, request.job.layer_thickness, deviation, std::move(writer)};
}

void LayerOutput::finish(Diagnostics& diagnostics, Report& report) {
  writer_->finish(diagnostics);
  if (deviation_) deviation_->rounding = writer_->greatest_rounding();
  report.deviation = deviation_;
  report.estimate = slicer::estimate_print(
      machine_, layer_thickness_, report.slice.layers, report.slice.volume,
      slicer::part_volume(report.slice.volume, report.slice.supports));
  report.snapped_layers = writer_->snapped_layers();
  writer_->commit();
  report.output_bytes = writer_->size();
}

}  // namespace lamina::compiler
