#pragma once
// Minkowski sums in the plane.
//
// Both regions are cut into convex polygons; the sum is the union of the sums
// of any two. Neighbours keep their common sides up to rounding, far below
// the distance at which edges are one: the union has no cracks.

#include "plane/region/region.h"

namespace lamina::plane {

// Convex polygons that cover the region and do not overlap, counter-clockwise,
// on the region's own corners.
std::vector<Contour> cut_into_convex(const Region& region);

// The sum of two convex polygons, each counter-clockwise: its sides are theirs
// by direction. Polygons of one or two points are fine.
Contour add_convex(const Contour& a, const Contour& b);

// The sum of two regions; empty if one is. Throws as unite() does.
Region add(const Region& a, const Region& b);

// The region without its holes.
Region fill(const Region& region);

}  // namespace lamina::plane
