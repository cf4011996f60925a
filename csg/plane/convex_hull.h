#pragma once
// The convex hull of points in the plane.

#include <vector>

#include "csg/plane/region.h"

namespace lamina::planar {

// One contour, strictly convex; nothing where all points lie on one line. The
// corners are the points themselves, and which of them are corners is decided
// exactly (see orientation()).
Region convex_hull(std::vector<Vec2> points);

}  // namespace lamina::planar
