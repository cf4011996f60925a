#pragma once
// How far the surface of a solid, not its leaves, reaches up and down.

#include "csg/scene.h"

namespace lamina::slicer {

// Heights [mm]; low > high where nothing is solid.
struct SurfaceHeights {
  double low = 1e300;
  double high = -1e300;

  bool is_empty() const { return low > high; }
};

// Looks at faces beyond those found so far only.
SurfaceHeights surface_heights(const csg::Scene& scene);

// Shifts the scene upwards or downwards until its lowest point is at height 0;
// x and y stay.
void place_on_bed(csg::Scene& scene);

}  // namespace lamina::slicer
