#pragma once
// Borders moved outwards or inwards, and pens drawn along paths.
//
// Corners are rounded to a grid of 1e-8 mm, 1500 times finer than OpenSCAD's
// 2^-16 mm, because the polygon clipper underneath is exact on integers and on
// nothing else. The grid is decimal, so that a coordinate such as 2.4 comes
// back as the same double, and a face that stands at a layer's height in the
// design still does.

#include <span>

#include "csg/plane/region.h"

namespace lamina::planar {

// Both throw csg::LimitExceeded for coordinates beyond
// csg::kGreatestCoordinate.

enum class Join { kRound, kMiter, kBevel };

// Moves the border outwards by `amount` [mm], inwards if that is negative.
//
// arc_tolerance  greatest distance of a round join from its arc [mm]
Region offset(const Region& region, double amount, Join join,
              double arc_tolerance);

enum class Cap { kButt, kRound, kSquare };

// What a pen of this width covers that draws the path from end to end.
//
// arc_tolerance  as for offset()
Region stroke(std::span<const Vec2> path, double width, Join join, Cap cap,
              double arc_tolerance);

}  // namespace lamina::planar
