#pragma once
// Borders moved outwards or inwards, and pens drawn along paths.
//
// The border's edges are moved and joined to a curve that winds around what
// they sweep as well; what it winds around is the result (Chen, McMains 2005;
// so does Clipper). Where the curve crosses itself too often, what a few edges
// sweep are strips, and these are united
// (docs/decisions/0041-strips-are-operands.md).
//
// Corners are rounded to a grid of 1e-8 mm, 1500 times finer than OpenSCAD's
// 2^-16 mm. The grid is decimal, so that a coordinate such as 2.4 comes back as
// the same double, and a face that lies at a layer's height in the design
// still does.

#include <span>

#include "plane/region/region.h"

namespace lamina::plane {

// Both throw LimitExceeded for coordinates beyond
// kGreatestCoordinate.

enum class Join { kRound, kMiter, kBevel };

// A round join takes steps of an angle that the tolerance gives, and a last
// one that may be shorter, or up to half as long again.
enum class ArcSteps { kNearest, kUp };

// Moves the border outwards by `amount` [mm], inwards if that is negative.
// Edges of the border shorter than a tie, and than a hundredth of the amount,
// are left out: their directions are rounding. Those of slivers are not.
//
// arc_tolerance  greatest distance of a round join's steps from its arc [mm]
Region offset(const Region& region, double amount, Join join,
              double arc_tolerance, ArcSteps steps = ArcSteps::kNearest);

enum class Cap { kButt, kRound, kSquare };

// What a pen of this width covers that draws the path from end to end.
//
// arc_tolerance  as for offset()
Region stroke(std::span<const Vec2> path, double width, Join join, Cap cap,
              double arc_tolerance);

}  // namespace lamina::plane
