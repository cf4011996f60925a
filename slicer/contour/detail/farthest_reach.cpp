#include "slicer/contour/detail/farthest_reach.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "plane/predicates.h"

namespace lamina::slicer {
namespace {

// A search goes on past the last vertex that a line reaches for this many
// vertices, and twice as many as that line spans.
constexpr std::uint32_t kPatience = 16;

// Directions of the lines from the anchor that pass all vertices so far within
// the tolerance, as slopes against the axis `along`.
//
// A line of slope s passes (x, y) by |y - s x| / sqrt(1 + s²). The tolerance is
// held against |y - s x| instead, which spares a square root for each vertex;
// s is small where a line goes far.
class Cone {
 public:
  Cone(Vec2 along, double tolerance)
      : along_(along), tolerance_(tolerance * std::sqrt(dot(along, along))) {}

  // Takes another vertex, seen from the anchor. Returns whether the cone held
  // it before.
  bool narrow(Vec2 to) {
    const double x = dot(along_, to);
    const double y = cross(along_, to);
    const bool is_held = y >= least_ * x && y <= greatest_ * x;
    least_ = std::max(least_, (y - tolerance_) / x);
    greatest_ = std::min(greatest_, (y + tolerance_) / x);
    if (x <= tolerance_) keep_ahead(x, y);
    return is_held;
  }
  bool is_empty() const { return least_ > greatest_; }

 private:
  // What is this near to the anchor is not to lie behind it either.
  void keep_ahead(double x, double y) {
    if (x <= 0) {
      least_ = kSteepest;
      greatest_ = -kSteepest;
    } else if (y > 0) {
      least_ = std::max(least_, -x / y);
    } else if (y < 0) {
      greatest_ = std::min(greatest_, -x / y);
    }
  }

  // Nothing farther off than the tolerance lies behind a line less steep.
  static constexpr double kSteepest = 1;

  Vec2 along_;
  double tolerance_;  // in units of the axis' length
  double least_ = -kSteepest;
  double greatest_ = kSteepest;
};

// The last vertex, at most `end`, that a line from `anchor` reaches.
std::uint32_t farthest_reach(std::span<const Vec2> points, std::uint32_t anchor,
                             std::uint32_t end, double tolerance) {
  if (end < anchor + 2) return end;
  // Most runs of a coarse section end at once; that is cheap to see: the line
  // to the second vertex misses the first.
  const Vec2 first = points[anchor + 1] - points[anchor];
  const Vec2 second = points[anchor + 2] - points[anchor];
  const double area = cross(first, second);
  const double first_squared = dot(first, first);
  const double second_squared = dot(second, second);
  if (area * area > tolerance * tolerance * second_squared ||
      first_squared == 0) {
    return anchor + 1;
  }
  std::uint32_t reach = anchor + 1;
  double farthest = first_squared;
  Cone cone(second_squared > first_squared ? second : first, tolerance);
  cone.narrow(first);
  for (std::uint32_t i = anchor + 2; i <= end; ++i) {
    const Vec2 to = points[i] - points[anchor];
    const bool is_held = cone.narrow(to);
    if (cone.is_empty()) break;
    if (!is_held && i - reach > kPatience + 2 * (reach - anchor)) break;
    // The end of a shortcut is its farthest vertex.
    const double squared = dot(to, to);
    if (squared >= farthest) {
      farthest = squared;
      if (is_held) reach = i;
    } else if (std::sqrt(squared) < std::sqrt(farthest) - tolerance) {
      break;  // it turns back
    }
  }
  return reach;
}

}  // namespace

void choose_farthest(std::span<const Vec2> points, std::uint32_t begin,
                     std::uint32_t end, double tolerance,
                     std::vector<std::uint32_t>& chosen) {
  const std::size_t size = chosen.size();
  chosen.resize(size + (end - begin) + 1);
  std::uint32_t* next = chosen.data() + size;
  for (std::uint32_t anchor = begin; anchor != end;) {
    *next++ = anchor;
    anchor = farthest_reach(points, anchor, end, tolerance);
  }
  *next++ = end;
  chosen.resize(static_cast<std::size_t>(next - chosen.data()));
}

}  // namespace lamina::slicer
