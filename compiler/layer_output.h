#pragma once
// The output of layers that a request asks for.

#include <memory>
#include <optional>

#include "base/diagnostic.h"
#include "base/file/output_file.h"
#include "compiler/report.h"
#include "compiler/request.h"
#include "slicer/contour/deviation.h"
#include "slicer/formats/layer_writer.h"

namespace lamina::compiler {

class LayerOutput {
 public:
  // Opens it; throws FileError where it or the printer's profile cannot be had.
  LayerOutput(const Request& request, TemporaryFiles& temporary_files);

  // Takes the layers.
  slicer::LayerSink& sink() { return *writer_; }

  // Ends the file and gives it its name. Completes what the report says of it.
  void finish(Diagnostics& diagnostics, Report& report);

 private:
  std::optional<slicer::Deviation> deviation_;
  std::unique_ptr<slicer::LayerWriter> writer_;
};

}  // namespace lamina::compiler
