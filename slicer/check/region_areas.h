#pragma once
// What two sets of contours have in common, as areas.
//
// The layer is cut into level bands, a few edges to each, so that long bars
// side by side are looked at in their own bands alone. In a band a line sweeps
// from left to right over both at once. In a strip between two ends of edges
// every edge reaches from side to side, and the area is a sum over edges: the
// integral of y, times what changes there; what enters through the lower side
// of the band is known by the edges that cross it. Where edges cross inside a
// strip, it is cut at the crossings, for those edges alone. No region is built
// and nothing is rounded to a grid, so contours may cross, touch and coincide;
// areas are exact but for rounding, 1e-15 of the part's size squared for each
// edge.

#include "plane/contours.h"

namespace lamina::slicer {

// Areas [mm²] of a and b: where the winding number of their contours is not 0.
struct RegionAreas {
  double both = 0;
  double only_a = 0;
  double only_b = 0;

  double a() const { return both + only_a; }
  double b() const { return both + only_b; }
};

// The time grows with the number of edges times that of edges on a vertical
// line within a band, and with crossings. Throws GeometryError where contours
// cross so often that it would take minutes: 10⁵ edges at random.
RegionAreas measure_regions(const plane::Contours& a, const plane::Contours& b);

}  // namespace lamina::slicer
