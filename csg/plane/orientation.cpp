#include "csg/plane/orientation.h"

#include <cmath>
#include <limits>

namespace lamina::planar {
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

}  // namespace lamina::planar
