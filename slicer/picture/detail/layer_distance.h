#pragma once
// How deep a place lies in a layer: the distance from its contours, up to a
// reach.

#include "base/vec.h"
#include "plane/contours.h"
#include "plane/edge_tree.h"

namespace lamina::slicer {

class LayerDistance {
 public:
  struct Depth {
    double depth = 0;  // more than 0 inside; -reach … reach [mm]
    // Where depth grows: a unit vector, or 0 out of reach.
    Vec2 inward = Vec2(0);
  };

  LayerDistance() = default;  // from nothing
  // reach  the greatest distance that is of interest [mm]
  LayerDistance(const plane::Contours& contours, double reach)
      : edges_(contours), reach_(reach) {}

  Depth at(Vec2 place) const;

 private:
  plane::EdgeTree edges_;
  double reach_ = 0;  // [mm]
};

}  // namespace lamina::slicer
