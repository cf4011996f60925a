#pragma once
// Polygons in space.

#include <cstdint>
#include <span>

#include "csg/scene.h"

namespace lamina::csg {

// Triangulates a polygon in space, planar or nearly so, convex or not, given by
// indices of the mesh's vertices, and appends the triangles. They run as the
// polygon does, and each edge of it is an edge of one triangle, so a closed
// mesh stays closed. Where the polygon is not planar the triangulation decides
// the shape: it is the Delaunay triangulation of the polygon's projection, as
// in OpenSCAD.
void add_face(Mesh& mesh, std::span<const std::uint32_t> face);

}  // namespace lamina::csg
