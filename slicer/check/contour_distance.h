#pragma once
// How far two sets of contours are from each other at most: the Hausdorff
// distance of their lines, of all points on them and not of vertices alone.
//
// The distance of a point from an edge is convex, so along an edge of one set,
// or a part of it, the distance from the other set is at most the greater one
// that its two ends have from any single edge there. A part for which that is
// no more than what has been found somewhere else is done with; the others are
// halved. Nearest edges are found in a tree of boxes over runs of edges, which
// lie near each other because they follow each other.

#include <cstdint>

#include "base/vec.h"
#include "ldni/section/contours.h"

namespace lamina::slicer {

struct ContourDistance {
  double distance = 0;  // [mm]; infinite where only one set has an edge
  // A point of one set that is so far from the other.
  Vec2 place = Vec2(0);
};

// At most this much less than the exact distance [mm].
constexpr double kDistanceResolution = 1e-7;

ContourDistance greatest_distance(const ldni::Contours& a,
                                  const ldni::Contours& b);

}  // namespace lamina::slicer
