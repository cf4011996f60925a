#pragma once
// The convex hull of points in space (see detail/quickhull.h).

#include <vector>

#include "csg/scene.h"

namespace lamina::csg {

// Returns a closed mesh; its vertices are the corners of the hull, which are
// some of the points, bit by bit, but that coordinates below 1e-74 mm count as
// 0. Empty where all points lie in one plane, up to rounding. Throws
// LimitExceeded for points beyond kGreatestCoordinate.
Mesh convex_hull(std::vector<Vec3> points);

// The hull of points in one plane: its corners, counter-clockwise around the
// normal; two of points on a line.
struct FlatHull {
  std::vector<Vec3> corners;
  Vec3 normal = Vec3(0);  // of unit length
};
FlatHull flat_hull(std::vector<Vec3> points);

// Returns the convex hull of a scene. Leaves that the program only unites give
// their vertices by formula; where the program subtracts or intersects, the
// boundary faces of the result give them. Empty where the solid has no volume.
// Throws LimitExceeded for more than kMostTriangles vertices.
Mesh convex_hull(Scene scene);

}  // namespace lamina::csg
