#pragma once
// Edges that meet nowhere but at their ends.
//
// The clipper rounds the points where edges cross to its grid. So it leaves
// edges that run along each other, or past a corner that touches them, but for
// the rounding. Here edges are threads and corners are nails: a thread that is
// as near to a nail as rounding explains goes through it. What ran along each
// other is the same then.
// Source: snap rounding (Hobby 1999). Departure: the nails are only the corners
// that are there.

#include <cstdint>
#include <span>
#include <vector>

#include "csg/plane/region.h"

namespace lamina::planar {

// From and to are names of points.
struct Edge {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
};

struct Drawing {
  std::vector<Vec2> points;  // by name, all different
  std::vector<Edge> edges;   // never two between the same points
};

// The contours' edges, led through all corners that are no farther from them
// than `snap` > 0. Of edges that become equal none is left, or one, so that
// what they enclose by the even-odd rule stays.
Drawing draw(std::span<const Contour> contours, double snap);

}  // namespace lamina::planar
