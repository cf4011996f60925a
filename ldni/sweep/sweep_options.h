#pragma once

#include "csg/tie_distance.h"
#include "ldni/section/chains.h"

namespace lamina::ldni {

// What the moving ray takes for one point, one edge, or nothing.
struct SweepOptions {
  // Distance of the look-ahead rays [mm]; 0 = auto. A speed knob only.
  double pitch = 0;
  // Edges nearer than this are one [mm].
  double tie_distance = kTieDistance;
  // Points of a loop nearer than this are one, and one that is nearer than
  // this to the line through its neighbours is left out [mm].
  double merge_distance = kClusterWidth;
  // Loops with less area [mm²] are dropped: 31 nm squared, the leftovers of
  // faces of solids that coincide up to rounding.
  double least_area = 1e-9;
};

}  // namespace lamina::ldni
