#pragma once
// Area, length and reach of loops of points.
//
// A loop is a closed polygon; whether its first point is repeated at its end
// makes no difference. Those who need several of these in one pass past the
// points add them up themselves; the functions do it for one loop.

#include <algorithm>
#include <span>

#include "base/lanes.h"
#include "base/vec.h"

namespace lamina {

// Adds up twice the signed area of a loop [mm²], point by point.
class DoubledArea {
 public:
  // Relative to the first point, so that a loop far from the origin keeps its
  // digits.
  DoubledArea(const Vec2& first, const Vec2& last)
      : origin_(lanes_of(first)), before_(lanes_of(last) - origin_) {}

  void add(const Vec2& point) {
    const Lanes here = lanes_of(point) - origin_;
    products_ += before_ * Lanes{here[1], here[0]};
    before_ = here;
  }
  double value() const { return products_[0] - products_[1]; }

 private:
  Lanes origin_;
  Lanes before_;
  Lanes products_ = both_lanes(0);
};

// The greatest coordinate of points, in magnitude [mm]; 0 of none.
class Reach {
 public:
  void add(const Vec2& point) {
    low_ = least(low_, lanes_of(point));
    high_ = greatest(high_, lanes_of(point));
  }
  double value() const {
    const Lanes reach = greatest(high_, -low_);
    return std::max(reach[0], reach[1]);
  }

 private:
  Lanes low_ = both_lanes(0);
  Lanes high_ = both_lanes(0);
};

// Positive where the loop runs counter-clockwise [mm²]; 0 of none.
double signed_area(std::span<const Vec2> loop);

// As signed_area(), but added up by triangles from the first point. Those of a
// sliver are small, and so is their rounding: for regions of the plane, where
// slivers come from rounding and the sign of one decides.
double sliver_area(std::span<const Vec2> loop);

double perimeter(std::span<const Vec2> loop);

// The box around points.
Box2 box_of(std::span<const Vec2> points);

// As Reach has it.
double greatest_coordinate(std::span<const Vec2> points);

}  // namespace lamina
