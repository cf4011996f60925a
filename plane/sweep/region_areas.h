#pragma once
// What two sets of contours have in common, as areas.
//
// The gaps of the moving ray over both (gap_sweep.h) are added up, each to what
// it lies in. No region is built and nothing is rounded to a grid, so contours
// may cross, touch and coincide; areas are exact but for rounding, 1e-15 of the
// part's size squared for each edge, and for gaps narrower than a cluster of
// events, 1e-9 mm.

#include "plane/contours.h"

namespace lamina::plane {

// Areas [mm²] of a and b: where the winding number of their contours is not 0.
struct RegionAreas {
  double both = 0;
  double only_a = 0;
  double only_b = 0;

  double a() const { return both + only_a; }
  double b() const { return both + only_b; }
};

// Throws GeometryError where contours cross so often that it would take
// minutes: 10⁵ edges at random.
RegionAreas measure_regions(const Contours& a, const Contours& b);

}  // namespace lamina::plane
