#include "compiler/tasks/plates.h"

#include <utility>

#include "compiler/compile.h"
#include "compiler/layer_output.h"
#include "compiler/machine.h"
#include "compiler/passes.h"
#include "compiler/warnings.h"
#include "slicer/contour/layer_measures.h"
#include "slicer/plate/plate_layers.h"

namespace lamina::compiler {
namespace {

// Measures layers on their way to a sink.
class MeasuringSink : public slicer::ForwardingSink {
 public:
  MeasuringSink(slicer::LayerSink& sink, slicer::SliceReport& report)
      : ForwardingSink(sink), report_(report) {}

  void take_encoded(const slicer::Layer& layer,
                    const std::string& encoded) override {
    report_.add(slicer::measure(layer.contours), layer.bottom, layer.top);
    ForwardingSink::take_encoded(layer, encoded);
  }

 private:
  slicer::SliceReport& report_;
};

}  // namespace

std::optional<PlatedPiece> slice_for_plates(Compilation& c) {
  c.report.machine = choose_machine(c.request.output, c.file_access());
  const auto lowered = make_geometry(c);
  if (!lowered || ends_strictly(c)) return std::nullopt;
  if (lowered->scene() == nullptr) {
    throw GeometryError("The design is flat: plates take solids");
  }
  slicer::LayerList list;
  c.report.slice =
      make_layers(c, *lowered, settings_of(c.request, c.report.machine), list);
  c.report.lines = find_lines(*lowered, c.report.slice);
  if (ends_strictly(c) || ends_on_findings(c)) return std::nullopt;
  return PlatedPiece{std::move(list.layers), c.report.slice};
}

void warn_of_plates(const Request& request, const FileAccess& access,
                    Diagnostics& diagnostics) {
  warn_of_machine(choose_machine(request.output, access), request, diagnostics);
}

Report write_plate(const Request& request,
                   std::span<const std::vector<slicer::Layer>> pieces,
                   std::span<const slicer::SliceReport> slices,
                   std::vector<slicer::Placement> placements,
                   TemporaryFiles& files, Diagnostics& diagnostics) {
  Report report;
  report.machine = choose_machine(request.output, files.file_access());
  for (const slicer::Placement& placement : placements) {
    const auto& supports = slices[placement.piece].supports;
    if (!supports) continue;
    if (!report.slice.supports) report.slice.supports.emplace();
    report.slice.supports->volume += supports->volume;
  }
  Diagnostics unshown;  // warn_of_plates() has said it
  LayerOutput output =
      LayerOutput::open(request, report.machine, files, unshown);
  MeasuringSink sink(output.sink(), report.slice);
  slicer::PlateLayers(pieces, std::move(placements),
                      request.job.layer_thickness)
      .send_to(sink);
  output.finish(diagnostics, report);
  return report;
}

}  // namespace lamina::compiler
