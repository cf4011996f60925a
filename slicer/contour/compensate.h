#pragma once
// Moves contours by the width of what draws them.
//
// A beam or a resin's bleeding cures beyond the path by some distance r, so the
// path is the contour of the points that are at least r inside the solid, which
// plane::offset gives: sides move by r, corners of a hole turn round, corners
// of the solid stay sharp. Moved outwards it is the reverse.
//
// Walls thinner than 2 r have no such path: they vanish and are counted.
//
// The first layers of a print are cured longest and grow farther: a foot, which
// an inset of their own mends. Light that shines through a layer cures what is
// below it; faces that look down must rise for that, which is a change of the
// scene (slicer/bleed/bleed.h).

#include <cstdint>

#include "plane/contours.h"

namespace lamina::slicer {

// Greatest lengths that make sense [mm]: no beam is wider, and no resin bleeds
// farther.
inline constexpr double kGreatestCompensation = 100;
inline constexpr double kGreatestFoot = 10;
inline constexpr double kGreatestBleed = 10;
inline constexpr std::uint32_t kMostFootLayers = 100;

// How much farther than others the first layers are moved inwards.
struct Foot {
  double inset = 0;  // of the first layer [mm]
  // It fades in even steps; behind so many layers nothing is left of it. Unless
  // given: as many as have an exposure of their own.
  std::uint32_t layers = 3;

  // Of layer `index` of the print, from 0 [mm].
  double of(std::uint32_t index) const;
  bool operator==(const Foot&) const = default;
};

// All that is done to a design so that its print has the design's sizes.
struct Compensation {
  double contour = 0;  // contours move inwards by this [mm]; negative: outwards
  Foot foot;
  double bleed = 0;  // faces that look down rise by this [mm]

  bool is_any() const { return contour != 0 || foot.inset != 0 || bleed != 0; }
  bool operator==(const Compensation&) const = default;
};

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
