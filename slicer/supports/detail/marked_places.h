#pragma once
// What contact finder and router ask of places.

#include "base/vec.h"
#include "slicer/contour/layer_solids.h"

namespace lamina::slicer::detail {

// The sides to which one looks from a place, in equal steps: side k as a
// direction of length 1.
inline constexpr int kSides = 16;
Vec2 side(int k);

// Where the design wants tips of another diameter; 0: none.
struct MarkedPlaces {
  double tip = 0;
  LayerSolids solids;
};

}  // namespace lamina::slicer::detail
