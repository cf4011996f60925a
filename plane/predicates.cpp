#include "plane/predicates.h"

#include <cmath>
#include <limits>
#include <utility>

#include "base/exact_sum.h"

namespace lamina {
namespace {

// Two products and a difference are rounded once each.
constexpr double kRelativeError = 4 * std::numeric_limits<double>::epsilon();

bool is_in_upper_half(Vec2 a) { return a.y > 0 || (a.y == 0 && a.x > 0); }

}  // namespace

int orientation(Vec2 a, Vec2 b, Vec2 c) {
  const Vec2 ab = b - a;
  const Vec2 ac = c - a;
  const double left = ab.x * ac.y;
  const double right = ab.y * ac.x;
  const double difference = left - right;
  if (std::abs(difference) >
      kRelativeError * (std::abs(left) + std::abs(right))) {
    return sign(difference);
  }
  // Without differences, which round: a×b + b×c + c×a.
  ExactSum<12> sum;
  for (const auto& [p, q] : {std::pair(a, b), {b, c}, {c, a}}) {
    sum.add_product(p.x, q.y);
    sum.add_product(-p.y, q.x);
  }
  return sum.sign();
}

int compare_angles(Vec2 a, Vec2 b) {
  const bool is_upper = is_in_upper_half(a);
  if (is_upper != is_in_upper_half(b)) return is_upper ? -1 : 1;
  return -orientation(Vec2(0), a, b);
}

int winding_number(std::span<const Vec2> loop, Vec2 point) {
  if (loop.empty()) return 0;
  int sum = 0;
  Vec2 from = loop.back();
  for (const Vec2 to : loop) {
    sum += crossing(from, to, point);
    from = to;
  }
  return sum;
}

}  // namespace lamina
