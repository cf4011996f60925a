#pragma once
// The area and the box of a loop, summed up in one pass over its points.

#include <algorithm>

#include "base/lanes.h"
#include "base/vec.h"

namespace lamina::ldni {

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

// The box of the points added and of the origin [mm].
class LoopBox {
 public:
  void add(const Vec2& point) {
    low_ = least(low_, lanes_of(point));
    high_ = greatest(high_, lanes_of(point));
  }
  // In magnitude; 0 of no points.
  double greatest_coordinate() const {
    const Lanes reach = greatest(high_, -low_);
    return std::max(reach[0], reach[1]);
  }

 private:
  Lanes low_ = both_lanes(0);
  Lanes high_ = both_lanes(0);
};

}  // namespace lamina::ldni
