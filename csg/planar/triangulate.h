#pragma once
// Triangles of a region, on its own vertices only.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "csg/planar/region.h"

namespace lamina::planar {

// Counter-clockwise triangles that cover the region; indices count the points
// of all contours in order. Every edge of the region is an edge of exactly one
// triangle and every other edge of two, whatever the input: a mesh that is
// closed with the region as a face is closed with these triangles.
std::vector<std::array<std::uint32_t, 3>> triangulate(const Region& region);

}  // namespace lamina::planar
