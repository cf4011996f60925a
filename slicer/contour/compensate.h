#pragma once
// Moves contours by the width of what draws them.
//
// A beam or a resin's bleeding cures beyond the path by some distance r, so the
// path is the contour of the points that are at least r inside the solid, which
// plane::offset gives: sides move by r, corners of a hole turn round, corners
// of the solid stay sharp. Moved outwards it is the reverse.
//
// Walls thinner than 2 r have no such path: they vanish and are counted.

#include <cstdint>

#include "plane/contours.h"

namespace lamina::slicer {

// What compensation lost, in one layer or in several.
struct CompensationCounts {
  std::uint64_t vanished_regions = 0;  // inwards: nothing is left of them
  std::uint64_t vanished_holes = 0;    // outwards: nothing is left of them
  std::uint64_t broken_walls = 0;      // inwards: regions came apart, or holes
                                       // met each other or the outside
  std::uint64_t closed_gaps = 0;       // outwards: the same for gaps

  CompensationCounts& operator+=(const CompensationCounts& other);
};

// Greatest distance of arcs from the circle that they stand for [mm]: a tenth
// of the default tolerance.
inline constexpr double kArcTolerance = 1e-4;

// Moves contours into the solid by `amount` [mm], or out of it where that is
// negative. Returns what is lost. Simple, disjoint loops stay so. Throws
// plane::LimitExceeded for coordinates beyond 1e9 mm.
CompensationCounts compensate(plane::Contours& contours, double amount);

}  // namespace lamina::slicer
