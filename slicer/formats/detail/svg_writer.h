#pragma once
// Writes SVG in the layout of Slic3r: a group per layer, of polygons that are
// contours (white) or holes (black), in millimetres (docs/formats.md).
//
// Coordinates are float32 (float_contours.h), as browsers hold them, with the
// shortest digits that read back as them. x and y are the design's; SVG's y
// runs downwards, so y is negated and the drawing shows a layer from above.
// The size of the drawing is known last: its numbers have a fixed width and
// are patched at the end.

#include <cstdint>
#include <span>
#include <string>

#include "slicer/formats/detail/float_writer.h"

namespace lamina::slicer {

class SvgWriter : public FloatWriter {
 public:
  SvgWriter(const std::string& path, TemporaryFiles& temporary_files);

  void take(const Layer& layer) override;
  // Warns where the numbers are too coarse for the design.
  void finish(Diagnostics& diagnostics) override;

 private:
  void write_svg_head();
  void write_loop(std::span<const FloatPoint> closed_loop);

  std::uint32_t layers_ = 0;
};

}  // namespace lamina::slicer
