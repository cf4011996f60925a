#pragma once
// Surfaces as sums take them: with flat neighbours joined.

#include <vector>

#include "csg/minkowski/convex.h"
#include "csg/minkowski/joined_faces.h"
#include "csg/scene.h"

namespace lamina::csg::detail {

// The convex solid around the points. Sums that rounding has put side by side
// count as one point: the facets between them have normals of noise.
Convex hull_of(const std::vector<Vec3>& points);

// Triangles in one plane that share an edge become one face.
JoinedFaces join(Mesh mesh);

}  // namespace lamina::csg::detail
