#pragma once
// Polygons in space.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace lamina::csg {

// Triangulates a polygon in space, planar or nearly so, convex or not, given by
// indices into `vertices`. The triangles run as the polygon does, and each edge
// of it is an edge of one triangle, so a closed mesh stays closed. Where the
// polygon is not planar the triangulation decides the shape: it is the Delaunay
// triangulation of the polygon's projection, as in OpenSCAD.
std::vector<std::array<std::uint32_t, 3>> triangulate_face(
    std::span<const Vec3> vertices, std::span<const std::uint32_t> face);

}  // namespace lamina::csg
