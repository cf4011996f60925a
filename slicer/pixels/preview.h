#pragma once
// A small picture of the part for the screen of a printer, drawn while layers
// come by.
//
// Seen from above at a slant, a higher place always hides a lower one on the
// same line of sight. So the sections are drawn over each other from the bottom
// to the top, each shifted by its height, and a pixel keeps the height that it
// shows; light takes its normals from the heights around it.

#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "slicer/contour/layer.h"
#include "slicer/pixels/coverage.h"

namespace lamina::slicer {

class Preview {
 public:
  Preview() = default;  // of nothing

  // box  of all layers
  explicit Preview(const Box3& box);

  // Takes the next layer.
  void take(const Layer& layer);

  // Returns rows from the top, of red, green and blue.
  std::vector<std::uint8_t> draw(unsigned width, unsigned height) const;

 private:
  void add(const Layer& layer, double z);

  double scale_ = 0;            // pixels per mm
  double next_z_ = 0;           // the least height that is drawn next
  PixelMap map_;                // of a section at the height 0
  std::vector<float> heights_;  // of the picture that is kept; NaN: nothing
};

}  // namespace lamina::slicer
