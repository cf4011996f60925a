#pragma once
// The planar graph of edges that meet nowhere but at their ends.
//
// The clipper rounds the points where edges cross to its grid. So it leaves
// edges that run along each other, or past a corner that touches them, but for
// the rounding. Here every corner is a hot pixel: an edge that passes as near
// to it as rounding explains is led through it. Edges that ran along each other
// are equal then.
// Source: snap rounding, Hobby, "Practical segment intersection with finite
// precision output", 1999. Departure: only corners are hot, not crossings.

#include <cstdint>
#include <span>
#include <vector>

#include "csg/plane/region.h"

namespace lamina::planar {

// From and to are indices of points.
struct Edge {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
};

struct PlanarGraph {
  std::vector<Vec2> points;  // all different
  std::vector<Edge> edges;   // never two between the same points
};

// The contours' edges, led through all corners that are no farther from them
// than `snap` > 0. Of edges that become equal none is left, or one, so that
// what they enclose by the even-odd rule stays.
PlanarGraph snap_round(std::span<const Contour> contours, double snap);

}  // namespace lamina::planar
