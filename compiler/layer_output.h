#pragma once
// The file or folder of layers that a request asks for.

#include <memory>
#include <optional>

#include "base/file/output_file.h"
#include "compiler/compilation.h"
#include "compiler/machine.h"
#include "slicer/contour/deviation.h"
#include "slicer/formats/layer_writer.h"
#include "slicer/machine/build_volume.h"

namespace lamina::compiler {

class LayerOutput {
 public:
  // Throws FileError where the output cannot be opened. Warns of exposures that
  // are not for them.
  //
  // machine  outlives it
  static LayerOutput open(const Request& request, const Machine& machine,
                          TemporaryFiles& temporary_files,
                          Diagnostics& diagnostics);

  // Takes the layers. Throws GeometryError where the printer cannot build them.
  slicer::LayerSink& sink() {
    if (build_volume_) return *build_volume_;
    return *writer_;
  }

  // Ends the file, gives it its name, and completes the report.
  void finish(Diagnostics& diagnostics, Report& report);

 private:
  LayerOutput(const Machine& machine, double layer_thickness,
              std::optional<slicer::Deviation> deviation,
              std::unique_ptr<slicer::LayerWriter> writer);

  const Machine& machine_;
  const double layer_thickness_;  // [mm]
  std::optional<slicer::Deviation> deviation_;
  std::unique_ptr<slicer::LayerWriter> writer_;
  std::optional<slicer::BuildVolumeSink> build_volume_;  // of a printer
};

}  // namespace lamina::compiler
