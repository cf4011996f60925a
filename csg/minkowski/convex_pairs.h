#pragma once
// The vertices that the sum of two convex solids can have.

#include <vector>

#include "csg/minkowski/convex.h"

namespace lamina::csg {

// p + q for all vertices p of a and q of b that lie farthest along a common
// direction, up to rounding: all vertices of the sum and few others. Two
// vertices have such a direction unless the normals around one all rise along
// an edge of the other. Cost: about the number of vertices found, not of all
// pairs.
std::vector<Vec3> extreme_sums(const Convex& a, const Convex& b);

}  // namespace lamina::csg
