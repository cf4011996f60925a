#pragma once
// Polygons in space.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace lamina::csg {

// Triangles of a polygon in space that is plane or nearly so, convex or not,
// given by indices into `vertices`; they run as the polygon does. Each edge of
// the polygon is an edge of one triangle, so nothing comes open. Of a polygon
// that is not plane the triangulation decides the shape: it is the Delaunay
// one of the polygon's projection, as OpenSCAD's.
std::vector<std::array<std::uint32_t, 3>> triangulate_face(
    std::span<const Vec3> vertices, std::span<const std::uint32_t> face);

}  // namespace lamina::csg
