#pragma once
// Booleans and offsets of regions.
//
// Coordinates are rounded to a grid of 1e-8 mm, 1500 times finer than
// OpenSCAD's 2^-16 mm, because the polygon clipper underneath is exact on
// integers and on nothing else. The grid is decimal, so that a coordinate such
// as 2.4 comes back as the same double, and a face that stands at a layer's
// height in the design still does. A region that needs no clipping is not
// rounded.

#include <span>

#include "csg/plane/region.h"

namespace lamina::planar {

// All of these throw csg::LimitExceeded for coordinates beyond
// csg::kGreatestCoordinate.

Region unite(std::span<const Region> regions);

// The first region without the others.
Region subtract(std::span<const Region> regions);

Region intersect(std::span<const Region> regions);

// Inside is where contours enclose a point an odd number of times, or where
// they wind other than 0 times around it.
enum class FillRule { kEvenOdd, kNonZero };

// The region that contours in any order and direction enclose; they may cross.
Region from_contours(std::span<const Contour> contours,
                     FillRule rule = FillRule::kEvenOdd);

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
