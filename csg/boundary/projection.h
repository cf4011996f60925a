#pragma once
// Solids seen from above, and cut at z = 0.

#include <cstdint>

#include "csg/scene.h"
#include "plane/region/region.h"

namespace lamina::csg {

// Both throw LimitExceeded for coordinates beyond kGreatestCoordinate.

// Returns the shadow of the solid on the plane z = 0.
plane::Region project(Scene scene);

// What counts of leaves whose surfaces lie in the plane z = 0.
enum class Touch : std::uint8_t {
  // Leaves have their surfaces, as in OpenSCAD 2021.01: what a leaf has just
  // above or just below the plane. A leaf that is taken away takes its surface
  // with it.
  kBothSides,
  kAbove,  // the solid just above the plane, as in newer OpenSCAD
};

// Returns the section at z = 0.
plane::Region cut_at_zero(const Scene& scene, Touch touch);

// Whether there is a solid, and all of it is above or below the plane z = 0.
bool misses_zero(Scene scene);

}  // namespace lamina::csg
