#pragma once
// Booleans of regions, by the moving ray (plane/sweep).
//
// Corners of the result are corners of the operands, as they were, or places
// where two edges cross, rounded once. Edges nearer than 3e-8 mm to each other
// are one; faces of solids tie at thirty times that (plane/tie_distance.h).
// Where many operands overlap they are swept group by group
// (docs/decisions/0027-cascaded-sweeps.md), so the cost is near-linear in the
// corners that come in and the crossings that come out.

#include <optional>
#include <span>

#include "plane/program/boolean_program.h"
#include "plane/region/region.h"
#include "plane/sweep/sweep_options.h"

namespace lamina::plane {

// All of these throw LimitExceeded for coordinates beyond
// kGreatestCoordinate.

void require_near(std::span<const Region> regions);

Region unite(std::span<const Region> regions);

// The first region without the others.
Region subtract(std::span<const Region> regions);

Region intersect(std::span<const Region> regions);

// What contours with winding numbers enclose in the window: where they are not
// 0.
Region clip(std::span<const Contour> contours, const Region& window);

// The region that contours in any order and direction enclose; they may cross.
Region from_contours(std::span<const Contour> contours,
                     FillRule rule = FillRule::kEvenOdd);

// As from_contours(); nothing where they cross so often that it costs less to
// unite parts of what they enclose.
std::optional<Region> from_few_crossings(std::span<const Contour> contours,
                                         FillRule rule);

}  // namespace lamina::plane
