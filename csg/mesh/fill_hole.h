#pragma once
// Holes of a surface, filled by the smallest surface that their rim allows.

#include <cstdint>
#include <span>

#include "csg/scene.h"

namespace lamina::csg {

// Appends triangles that fill a loop of the mesh's vertices, planar or not, and
// run as it does; each edge of it is an edge of one of them. Of all surfaces
// without vertices of their own they have the least area (Barequet and Sharir
// 1995), so that what was a crack is not made a hollow. Loops of hundreds of
// edges are parted at their narrowest place first.
void fill_hole(Mesh& mesh, std::span<const std::uint32_t> loop);

}  // namespace lamina::csg
