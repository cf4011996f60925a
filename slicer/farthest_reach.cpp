#include "slicer/farthest_reach.h"

#include <algorithm>
#include <cmath>

#include "slicer/plane.h"

namespace lamina::slicer {
namespace {

// A search for the next vertex goes on for so many vertices, and twice as many
// as it has reached, after the last one that a line reaches.
constexpr std::uint32_t kPatience = 16;

Vec2 left_of(Vec2 a) { return {-a.y, a.x}; }

// Directions of the lines from the anchor that pass all vertices so far within
// the tolerance.
class Cone {
 public:
  // The first vertex, seen from the anchor, and the square of its distance.
  Cone(double tolerance, Vec2 to, double squared)
      : tolerance_(tolerance), tolerance_squared_(tolerance * tolerance) {
    const double cosine = cosine_of(squared);
    right_ = right_side(to, cosine);
    left_ = left_side(to, cosine);
  }

  // Takes another vertex. Whether the cone held it before.
  bool narrow(Vec2 to, double squared) {
    const double cosine = cosine_of(squared);
    const double past_right = cross(right_, to);
    const double past_left = cross(to, left_);
    // The new sides beside the old ones, multiplied out.
    if (cosine * past_right > tolerance_ * dot(right_, to)) {
      right_ = right_side(to, cosine);
    }
    if (cosine * past_left > tolerance_ * dot(left_, to)) {
      left_ = left_side(to, cosine);
    }
    return past_right >= 0 && past_left >= 0;
  }
  bool is_empty() const { return cross(right_, left_) < 0; }

 private:
  // Of half the angle, times the distance; its sine is the tolerance. What is
  // nearer than the tolerance asks for no more than not to lie behind the
  // anchor.
  double cosine_of(double squared) const {
    return std::sqrt(std::max(0.0, squared - tolerance_squared_));
  }
  Vec2 right_side(Vec2 to, double cosine) const {
    return to * cosine - left_of(to) * tolerance_;
  }
  Vec2 left_side(Vec2 to, double cosine) const {
    return to * cosine + left_of(to) * tolerance_;
  }

  double tolerance_;
  double tolerance_squared_;
  Vec2 right_;
  Vec2 left_;
};

}  // namespace

std::uint32_t farthest_reach(std::span<const Vec2> points, std::uint32_t anchor,
                             std::uint32_t end, double tolerance) {
  if (end < anchor + 2) return end;
  // Most runs of a coarse section end at once; that is cheap to see: no line
  // passes both vertices.
  const Vec2 first = points[anchor + 1] - points[anchor];
  const Vec2 second = points[anchor + 2] - points[anchor];
  const double area = cross(first, second);
  if (area * area >
      2 * tolerance * tolerance * (dot(first, first) + dot(second, second))) {
    return anchor + 1;
  }
  std::uint32_t reach = anchor + 1;
  double farthest = dot(first, first);  // squared
  if (farthest == 0) return anchor + 1;
  Cone cone(tolerance, first, farthest);
  for (std::uint32_t i = anchor + 2; i <= end; ++i) {
    const Vec2 to = points[i] - points[anchor];
    const double squared = dot(to, to);
    const bool is_passed = cone.narrow(to, squared);
    // The end of a shortcut is its farthest vertex.
    if (squared >= farthest) {
      farthest = squared;
      if (is_passed) reach = i;
    } else if (std::sqrt(squared) < std::sqrt(farthest) - tolerance) {
      break;  // it turns back
    }
    if (cone.is_empty()) break;
    if (i - reach > kPatience + 2 * (reach - anchor)) break;
  }
  return reach;
}

}  // namespace lamina::slicer
