#include "base/plane.h"

#include <cmath>
#include <limits>

namespace lamina {
namespace {

int sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

// Two products and a difference are rounded once each.
constexpr double kRelativeError = 4 * std::numeric_limits<double>::epsilon();

// p·q - r·s, exact in sign: each product is split into its rounded value and
// the rest, which fma gives exactly.
int sign_of_difference(double p, double q, double r, double s) {
  const double pq = p * q;
  const double rs = r * s;
  if (pq != rs) return sign(pq - rs);
  return sign(std::fma(p, q, -pq) - std::fma(r, s, -rs));
}

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
  return sign_of_difference(ab.x, ac.y, ab.y, ac.x);
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

double distance_to_segment(Vec2 point, Vec2 from, Vec2 to) {
  const Vec2 away =
      point - (from + nearest_share(point, from, to) * (to - from));
  return std::sqrt(dot(away, away));
}

}  // namespace lamina
