#pragma once
// The Hausdorff distance of two sets of contours: of all points on their lines,
// not of vertices alone.
//
// The distance of a point from an edge is convex, so along an edge of one set,
// or a part of it, the distance from the other set is at most the greater one
// that its two ends have from any single edge there. A part for which that is
// no more than what has been found elsewhere is done with; the others are
// halved. A tree of boxes over successive edges finds nearest edges.

#include "base/vec.h"
#include "plane/contours.h"

namespace lamina::slicer {

struct ContourDistance {
  double distance = 0;  // [mm]; infinite where only one set has an edge
  // A point of one set at that distance from the other.
  Vec2 place = Vec2(0);
};

// The result falls short of the exact distance by at most this [mm].
constexpr double kDistanceResolution = 1e-7;

ContourDistance greatest_distance(const plane::Contours& a,
                                  const plane::Contours& b);

}  // namespace lamina::slicer
