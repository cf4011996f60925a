#pragma once
// Counts and measures of one layer.

#include <cstddef>

#include "ldni/section/contours.h"

namespace lamina::slicer {

struct LayerMeasures {
  std::size_t loops = 0;
  std::size_t holes = 0;
  std::size_t vertices = 0;
  double area = 0;       // holes count negative [mm²]
  double perimeter = 0;  // of all loops [mm]
};

LayerMeasures measure(const ldni::Contours& contours);

}  // namespace lamina::slicer
