#pragma once
// Writes CLI 2.0 (Common Layer Interface), binary or ASCII
// (docs/formats.md).
//
// Both hold the same float32 numbers (float_contours.h); ASCII has the
// shortest digits that read back as them. A layer's height is that of its
// upper side. Outer loops have direction 1, holes 0.
//
// The header tells the box and the number of layers, which are known last:
// these have a fixed width and are patched at the end. It tells no date, so
// that the same design gives the same bytes.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "slicer/formats/detail/float_writer.h"
#include "slicer/formats/output_format.h"

namespace lamina::slicer {

class CliWriter : public FloatWriter {
 public:
  CliWriter(const std::string& path, TemporaryFiles& temporary_files,
            CliEncoding encoding);

  // Throws FileError where two layers fall on the same float32 height.
  void take(const Layer& layer) override;
  // Warns where the numbers are too coarse for the design.
  void finish(Diagnostics& diagnostics) override;

 private:
  void write_header();
  void write_height(float z);
  void write_loop(std::span<const FloatPoint> loop);

  const CliEncoding encoding_;
  std::uint32_t layers_ = 0;
  float bottom_z_ = 0;  // of the first layer
  float top_z_ = 0;     // of the last one
};

}  // namespace lamina::slicer
