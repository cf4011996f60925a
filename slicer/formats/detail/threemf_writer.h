#pragma once
// Writes 3MF with a stack of slices (Slice Extension 1.0.2; docs/formats.md).
//
// The package's XML goes straight into the archive, layer by layer, so memory
// does not grow with the design; a library that builds the whole model first
// would hold all layers (docs/decisions/0018-3mf-without-lib3mf.md). Every
// reader needs a mesh: the box of all layers, marked as too coarse to slice.
//
// Coordinates are float32 (float_contours.h), as common readers hold them.

#include <optional>
#include <span>
#include <string>

#include "base/file/zip_output.h"
#include "slicer/formats/detail/float_writer.h"

namespace lamina::slicer {

class ThreemfWriter : public FloatWriter {
 public:
  // deviation  as WriterOptions has it
  ThreemfWriter(const std::string& path, TemporaryFiles& temporary_files,
                std::optional<double> deviation);

  void take(const Layer& layer) override;
  // Warns where the numbers are too coarse for the design.
  void finish(Diagnostics& diagnostics) override;

 private:
  void begin_stack(const Layer& first);
  void write_slice(float top);
  std::string object() const;

  const std::optional<double> deviation_;
  ZipOutput archive_;
  std::string text_;  // of the slice in hand
  bool has_layers_ = false;
  float bottom_z_ = 0;  // of the first layer
  float top_z_ = 0;     // of the last one
};

}  // namespace lamina::slicer
