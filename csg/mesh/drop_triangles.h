#pragma once
// Triangles that say nothing.

#include <cstddef>

#include "csg/scene.h"

namespace lamina::csg {

// Drops triangles that name a vertex twice. Returns how many.
std::size_t drop_degenerate(Mesh& mesh);

// Keeps the first of triangles with the same corners in the same order. Returns
// how many were dropped.
std::size_t drop_repeated(Mesh& mesh);

}  // namespace lamina::csg
