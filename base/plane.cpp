#include "base/plane.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace lamina {
namespace {

int sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

// Two products and a difference are rounded once each.
constexpr double kRelativeError = 4 * std::numeric_limits<double>::epsilon();

// A sum of doubles, kept exactly: none of them overlaps another one, and they
// grow. Source: Shewchuk, "Adaptive precision floating-point arithmetic and
// fast robust geometric predicates", 1997, Grow-Expansion.
class ExactSum {
 public:
  void add(double x) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const double sum = x + terms_[i];
      const double part = sum - x;
      const double rest = (x - (sum - part)) + (terms_[i] - part);
      if (rest != 0) terms_[kept++] = rest;
      x = sum;
    }
    size_ = kept;
    if (x != 0) terms_[size_++] = x;
  }
  void add_product(double p, double q) {
    add(std::fma(p, q, -(p * q)));
    add(p * q);
  }
  int sign() const { return size_ == 0 ? 0 : lamina::sign(terms_[size_ - 1]); }

 private:
  std::array<double, 12> terms_{};  // of as many that orientation() adds
  std::size_t size_ = 0;
};

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
  // The same, without differences, which round: a×b + b×c + c×a.
  ExactSum sum;
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

double distance_to_segment(Vec2 point, Vec2 from, Vec2 to) {
  const Vec2 away =
      point - (from + nearest_share(point, from, to) * (to - from));
  return std::sqrt(dot(away, away));
}

}  // namespace lamina
