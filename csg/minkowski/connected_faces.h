#pragma once
// Connected components of a boundary that comes face by face.

#include <span>
#include <vector>

#include "csg/minkowski/convex.h"

namespace lamina::csg {

// Returns at least one point on each connected component of a set of flat
// faces. Faces are connected where a corner of one lies on the other; where
// rounding hides that, there is a point too many, which does no harm in a sum.
std::vector<Vec3> points_of_components(std::span<const Convex> faces);

}  // namespace lamina::csg
