#pragma once
// What the faces of a Boolean are the boundary of.

#include <span>
#include <vector>

#include "csg/boundary/boundary_faces.h"
#include "csg/scene.h"

namespace lamina::csg {

// Those of all contours, face by face.
std::vector<Vec3> corners_of(std::span<const BoundaryFace> faces);

// Whether the faces of a solid are the boundary of their hull, up to rounding:
// no corner lies above the plane of any face. Cost: about √n for each face of a
// convex solid; others are seldom asked to the end.
bool is_convex(std::span<const BoundaryFace> faces);

// The faces as triangles; equal vertices are one.
Mesh triangulate(std::span<const BoundaryFace> faces);

}  // namespace lamina::csg
