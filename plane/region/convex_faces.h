#pragma once
// Convex polygons from triangles, in space or in the plane.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace lamina::plane {

// A convex polygon by its corners.
struct Face {
  std::vector<std::uint32_t> corners;  // they run as the triangles do
  Vec3 normal = Vec3(0);  // unit length; 0 where the corners are on a line
};

// Joins coplanar triangles to convex polygons, greedily: at most four times as
// many as the fewest possible (Hertel and Mehlhorn 1983). Of the triangles of a
// convex solid its facets remain. Corners where a straight side meets other
// faces stay.
std::vector<Face> merge_to_convex(
    std::span<const Vec3> vertices,
    std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace lamina::plane
