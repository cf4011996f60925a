#pragma once
// Triangles of a region, on its own vertices only.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "plane/region/region.h"

namespace lamina::plane {

// Counter-clockwise triangles that cover the region; indices count the points
// of all contours in order. Every edge of the region is an edge of exactly one
// triangle and every other edge of two, whatever the input: a mesh that is
// closed with the region as a face is closed with these triangles.
std::vector<std::array<std::uint32_t, 3>> triangulate(const Region& region);

// Turns diagonals until each is the better one for its two triangles (the two
// angles opposite to it make less than 180°), as far as the border allows.
// Diagonals that are about as good as the other stay.
void make_delaunay(std::span<const Vec2> points,
                   std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace lamina::plane
