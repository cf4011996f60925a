#pragma once
// What every layer must keep, whatever design it came from.
//
// Loops are simple, closed, disjoint, oriented by their nesting and free of
// repeated points, collinear points and loops without area. The checks know
// nothing of how the contours were made. Edges are sorted into a uniform grid
// of about one cell an edge, so that a layer of 10⁶ points takes about a
// second; distances are judged in doubles, whose rounding (1e-12 mm at 1e4 mm)
// is small against every threshold below.

#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/vec.h"
#include "plane/contours.h"

namespace lamina::support {

// Thresholds [mm, mm²]. The defaults are what the kinetic ray promises at
// tolerance 0 for designs within some 100 mm of the origin.
struct ContourRules {
  // Neighbouring points at least this far apart.
  double repeat_distance = 1e-9;
  // A point at least this far from the line through its neighbours. Small: a
  // circle of radius 1 with 10⁴ facets keeps 5e-8 between arc and chord.
  double collinear_distance = 1e-12;
  double least_area = 1e-9;
  // Edges that run into each other by no more than this touch, they do not
  // cross. Two loops may touch in a point (squares corner to corner); one
  // loop may not touch itself, for it can always be split there.
  double touch_distance = 1e-9;
};

struct ContourDefect {
  enum class Kind {
    kNotFinite,         // a coordinate is infinite or no number
    kTooFewPoints,      // fewer than three
    kRepeatedPoint,     // equals the next one
    kCollinearPoint,    // on the line of its neighbours, spikes included
    kZeroArea,          // of a whole loop
    kCrossing,          // two edges cross
    kOverlap,           // two edges run along each other
    kTouchesItself,     // a loop meets itself in a point
    kWrongOrientation,  // an outer loop clockwise, or a hole the other way
  };
  Kind kind;
  std::size_t loop = 0;
  Vec2 place = Vec2(0);
  std::string message;  // the whole sentence, with the place
};

// All defects, but no more than a few hundred; empty for sound contours.
// Orientation is only judged where nothing crosses.
std::vector<ContourDefect> find_defects(const plane::Contours& contours,
                                        const ContourRules& rules = {});

// The same as a GoogleTest assertion:
//   EXPECT_TRUE(are_sound(layer.contours)) << "at z = " << layer.section_z;
::testing::AssertionResult are_sound(const plane::Contours& contours,
                                     const ContourRules& rules = {});

// Loops by the sign of their area. For sound contours these are the regions
// (components of the open interior) and the holes, save where holes touch each
// other in points all the way around an island.
struct LoopCounts {
  std::size_t outer = 0;
  std::size_t holes = 0;

  bool operator==(const LoopCounts&) const = default;
};
LoopCounts count_loops(const plane::Contours& contours);
std::ostream& operator<<(std::ostream& out, const LoopCounts& counts);

// Sum of winding numbers of all loops around `point`: 1 inside the solid, 0
// outside, for sound contours. Exactly on an edge: either. O(points).
int winding_number(const plane::Contours& contours, Vec2 point);
bool contains(const plane::Contours& contours, Vec2 point);

// Sums over all loops; holes count negative in the area.
double total_area(const plane::Contours& contours);
double total_perimeter(const plane::Contours& contours);

// Distance [mm] from a point to the nearest edge; infinite without any.
double distance_to_edges(const plane::Contours& contours, Vec2 point);

// Greatest distance [mm] from the vertices and edge middles of either to the
// edges of the other; infinite where only one is empty. O(points²).
double greatest_distance(const plane::Contours& a, const plane::Contours& b);

// Appends one loop.
void add_loop(plane::Contours& contours, const std::vector<Vec2>& points);

}  // namespace lamina::support
