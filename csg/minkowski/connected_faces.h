#pragma once
// Connected components of a boundary that comes face by face.

#include <vector>

#include "csg/minkowski/joined_faces.h"

namespace lamina::csg {

// Returns at least one point on each connected component of a surface: of its
// edges, the point nearest to `aim`. Faces are connected where they share an
// edge, or a corner of one lies on the other; where rounding hides that, there
// is a point too many, which does no harm in a sum.
std::vector<Vec3> points_of_components(const JoinedFaces& surface,
                                       const Vec3& aim);

}  // namespace lamina::csg
