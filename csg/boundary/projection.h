#pragma once
// Solids seen from above, and cut at z = 0.

#include "csg/scene.h"
#include "plane/region/region.h"

namespace lamina::csg {

// Both throw LimitExceeded for coordinates beyond kGreatestCoordinate.

// Returns the shadow of the solid on the plane z = 0.
plane::Region project(Scene scene);

// Returns the section at z = 0 of the solid with its surface: a solid that only
// touches the plane leaves what it touches there. So it is the section just
// above and the one just below, both.
plane::Region cut_at_zero(const Scene& scene);

// Whether there is a solid, and all of it is above or below the plane z = 0.
bool misses_zero(Scene scene);

}  // namespace lamina::csg
