#pragma once
// A region of the plane, bounded by polygons.
//
// A region is taken apart contour by contour: an extrusion makes each one a
// solid or a cavity of its own, fill() drops those that are holes, triangles
// need an owner for each hole. So each contour is a simple polygon by itself,
// and its direction shows what it is.

#include <cstddef>
#include <span>
#include <vector>

#include "base/vec.h"
#include "plane/contours.h"

namespace lamina::plane {

// One closed polygon; the first point is not repeated at the end.
using Contour = std::vector<Vec2>;

// Outer contours run counter-clockwise, holes clockwise: together they wind
// once around each point inside and not at all around others. No contour goes
// through a point twice. Contours may touch in points; they never cross, but
// for rounding.
//
// Contours that a comment calls contours with winding numbers keep none of
// this.
struct Region {
  std::vector<Contour> contours;

  bool is_empty() const { return contours.empty(); }
  bool operator==(const Region&) const = default;
};

// The box around contours.
Box2 box_of(std::span<const Contour> contours);

// Adds up all contours; holes count negative [mm²].
double area(const Region& region);

std::size_t corner_count(const Region& region);

// Drops contours whose mean width is less than `width` [mm].
void drop_hairlines(Region& region, double width);

// Converts from and to the loops of layers.
Region to_region(const Contours& contours);
Contours to_contours(const Region& region);

// The convex hull of the points: one contour, strictly convex; nothing where
// all points lie on one line. The corners are the points themselves, and which
// of them are corners is decided exactly (see orientation()).
Region convex_hull(std::vector<Vec2> points);

}  // namespace lamina::plane
