#pragma once
// Footprints: what pieces cover of the plate on which they are printed.

#include <span>

#include "base/vec.h"
#include "plane/region/region.h"
#include "slicer/contour/layer.h"

namespace lamina::slicer {

// Returns a region that holds the contours of all layers: what a piece covers,
// seen from above. Its border is nowhere farther than twice the tolerance from
// that of their union.
//
// The layers are simplified before they are united, so that hundreds of layers
// of a thousand points take a moment; what that may cut off is added again
// around the union. Batches of layers are united in several threads; their
// number does not change the result.
//
// tolerance  above 0 [mm]
// throws     LimitExceeded for coordinates beyond plane::kGreatestCoordinate
plane::Region footprint_of(std::span<const Layer> layers,
                           double tolerance = 0.01);

// A turn about the origin, counter-clockwise, then a shift [mm]. Quarter turns
// are exact.
class PlateMotion {
 public:
  PlateMotion(double turn_deg, Vec2 shift);

  Vec2 operator()(Vec2 p) const {
    return Vec2(x_axis_.x * p.x - x_axis_.y * p.y,
                x_axis_.y * p.x + x_axis_.x * p.y) +
           shift_;
  }

 private:
  Vec2 x_axis_;
  Vec2 shift_;
};

// Returns the region turned about the origin, counter-clockwise, then shifted
// [mm]. Quarter turns are exact.
plane::Region place(const plane::Region& region, double turn_deg, Vec2 shift);

}  // namespace lamina::slicer
