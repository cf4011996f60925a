#pragma once
// The output of layers that a request asks for.

#include <memory>

#include "base/diagnostic.h"
#include "base/file/output_file.h"
#include "compiler/compilation.h"
#include "slicer/formats/layer_writer.h"

namespace lamina::compiler {

class LayerOutput {
 public:
  // Opens the output. Throws FileError where it or the printer's profile cannot
  // be opened.
  LayerOutput(const Request& request, TemporaryFiles& temporary_files);

  // Takes the layers.
  slicer::LayerSink& sink() { return *writer_; }

  // Ends the file, gives it its name, and completes the report.
  void finish(Diagnostics& diagnostics, Report& report);

 private:
  std::optional<slicer::Deviation> deviation_;
  std::unique_ptr<slicer::LayerWriter> writer_;
};

}  // namespace lamina::compiler
