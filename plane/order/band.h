#pragma once
// Strips that chains keep to, for a cheap answer to whether two are apart.
//
// From one vertex to another a chain stays near the line that joins them, much
// nearer than to any box: so two differences separate two chains that run side
// by side, however steep they are and however many vertices they have on the
// way.

#include <algorithm>
#include <cmath>

#include "base/vec.h"

namespace lamina::plane {

struct Band {
  Band() = default;
  // The chain from vertex `first`, whence it goes on with that slope, to the
  // next vertex at x ≥ limit, else to its end, vertex `last`.
  Band(const Vec2* first, double first_slope, const Vec2* last, double limit)
      : left(first->x),
        right(first[1].x),
        y(first->y),
        ends_chain(first + 1 == last) {
    if (ends_chain || right >= limit) {
      follow(first_slope, first[1].y);
    } else {
      enclose(first, last, limit);
    }
  }

  double lowest_at(double x) const { return y + (x - left) * slope + low; }
  double highest_at(double x) const { return y + (x - left) * slope + high; }

  double left = 0;  // x of the two vertices
  double right = 0;
  double y = 0;      // of the left one
  double slope = 0;  // of the line
  double low = 0;    // reach of the strip below and above the line
  double high = 0;
  bool ends_chain = false;  // on its right

 private:
  // A line steeper than this is not followed: rounding of x would move it by
  // more than kBandRounding.
  static constexpr double kSteepest = 64;

  // Follows one segment.
  void follow(double steepness, double right_y) {
    if (std::abs(steepness) <= kSteepest) {
      slope = steepness;
    } else {
      low = std::min(0.0, right_y - y);
      high = std::max(0.0, right_y - y);
    }
  }
  void enclose(const Vec2* first, const Vec2* last, double limit);
};

// A range of x [mm], empty unless begin < end.
struct XRange {
  double begin = 0;
  double end = 0;
};

// What rounding may take off the distance of two bands [mm], in a design of
// metres; below every distance that is asked for in earnest.
inline constexpr double kBandRounding = 1e-9;

// Where, from x on as far as both reach, the upper band is known to be more
// than `distance` above the lower one.
inline XRange range_apart(const Band& lower, const Band& upper, double x,
                          double distance) {
  const double end = std::min(lower.right, upper.right);
  const auto gap_at = [&](double place) {
    return upper.lowest_at(place) - lower.highest_at(place) -
           (distance + kBandRounding);
  };
  const double gap = gap_at(x);
  const double gap_at_end = gap_at(end);
  if (std::min(gap, gap_at_end) > 0) return {x, end};
  if (std::max(gap, gap_at_end) <= 0) return {};
  // The gap of two lines changes evenly.
  const double zero = x + (end - x) * (gap / (gap - gap_at_end));
  return gap > 0 ? XRange{x, zero} : XRange{zero, end};
}

}  // namespace lamina::plane
