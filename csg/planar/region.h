#pragma once
// A region of the plane, bounded by polygons.

#include <span>
#include <vector>

#include "csg/vec.h"

namespace lamina::planar {

// One closed polygon; the first point is not repeated at the end.
using Contour = std::vector<Vec2>;

// Outer contours run counter-clockwise, holes clockwise. Contours may touch in
// points; they never cross.
struct Region {
  std::vector<Contour> contours;

  bool is_empty() const { return contours.empty(); }
  bool operator==(const Region&) const = default;
};

// Positive where the contour runs counter-clockwise [mm²].
double signed_area(std::span<const Vec2> contour);

// Of all contours: holes count negative [mm²].
double area(const Region& region);

// Drops contours whose mean width is less than `width` [mm].
void drop_hairlines(Region& region, double width);

// 2D modules. Empty where a size is not positive or not finite.
Region square(Vec2 size, bool center);
Region circle(double r, int fragments);

}  // namespace lamina::planar
