#include "csg/boundary/detail/orientation.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <glm/geometric.hpp>

#include "base/exact_sum.h"

namespace lamina::csg {
namespace {

// A number as the sum of two doubles, the second one far smaller.
struct Pair {
  double high = 0;
  double low = 0;

  explicit Pair(double number) : high(number) {}
  Pair(double sum, double rest) : high(sum), low(rest) {}
  explicit operator double() const { return high + low; }

  friend Pair operator+(Pair a, Pair b) {
    const double sum = a.high + b.high;
    const double part = sum - a.high;
    const double rest = (a.high - (sum - part)) + (b.high - part);
    return {sum, rest + (a.low + b.low)};
  }
  friend Pair operator-(Pair a, Pair b) { return a + Pair(-b.high, -b.low); }
  friend Pair operator*(Pair a, Pair b) {
    const double product = a.high * b.high;
    const double rest = std::fma(a.high, b.high, -product);
    return {product, rest + (a.high * b.low + a.low * b.high)};
  }
};

// Bounds the error of the determinant as a share of the sum of its products'
// sizes, u being half of epsilon. Of doubles it is (7 + 56 u) u, Shewchuk's
// o3derrboundA. Of pairs differences are exact, and what products and sums lose
// is less than 64 u² = 2^-100 altogether.
template <typename Number>
constexpr double kRelativeError = 4 * std::numeric_limits<double>::epsilon();
template <>
constexpr double kRelativeError<Pair> = 0x1p-99;

template <typename Number>
using Direction = std::array<Number, 3>;

template <typename Number>
Direction<Number> direction(const Vec3& from, const Vec3& to) {
  return {Number(to.x) - Number(from.x), Number(to.y) - Number(from.y),
          Number(to.z) - Number(from.z)};
}

// u × v, and for each coordinate the sum of its products' sizes.
template <typename Number>
struct Normal {
  Normal(const Direction<Number>& u, const Direction<Number>& v)
      : value{minor(u, v, 1, 2, size.x), minor(u, v, 2, 0, size.y),
              minor(u, v, 0, 1, size.z)} {}

  Vec3 size;
  Direction<Number> value;

 private:
  static Number minor(const Direction<Number>& u, const Direction<Number>& v,
                      std::size_t j, std::size_t k, double& size) {
    const Number left = u[j] * v[k];
    const Number right = u[k] * v[j];
    size = std::abs(double(left)) + std::abs(double(right));
    return left - right;
  }
};

// Sets the sign of (b - a) × (c - a) · (d - a) and returns true, unless
// rounding may have changed it. Nothing is rounded where all products are 0.
template <typename Number>
bool find_sign(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
               int& result) {
  const Normal<Number> normal(direction<Number>(a, b), direction<Number>(a, c));
  const Direction<Number> away = direction<Number>(a, d);
  const Number sum = away[0] * normal.value[0] + away[1] * normal.value[1] +
                     away[2] * normal.value[2];
  const Vec3 distance(std::abs(double(away[0])), std::abs(double(away[1])),
                      std::abs(double(away[2])));
  const double size = glm::dot(distance, normal.size);
  result = sign(double(sum));
  return std::abs(double(sum)) >= kRelativeError<Number> * size;
}

using Difference = ExactSum<2>;

Difference difference(double a, double b) {
  Difference result;
  result.add(a);
  result.add(-b);
  return result;
}

int find_exact_sign(const Vec3& a, const Vec3& b, const Vec3& c,
                    const Vec3& d) {
  ExactSum<192> sum;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    ExactSum<16> minor;
    minor.add_product(difference(b[j], a[j]), difference(c[k], a[k]));
    minor.add_product(difference(a[k], b[k]), difference(c[j], a[j]));
    sum.add_product(minor, difference(d[i], a[i]));
  }
  return sum.sign();
}

}  // namespace

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  int sign = 0;
  if (find_sign<double>(a, b, c, d, sign)) return sign;
  if (find_sign<Pair>(a, b, c, d, sign)) return sign;
  return find_exact_sign(a, b, c, d);
}

OrientedPlane::OrientedPlane(const Vec3& a, const Vec3& b, const Vec3& c,
                             const Vec3& extent)
    : corner_(a) {
  const Normal<double> normal(direction<double>(a, b), direction<double>(a, c));
  normal_ = {normal.value[0], normal.value[1], normal.value[2]};
  rounding_ = kRelativeError<double> *
              (extent.x * normal.size.x + extent.y * normal.size.y +
               extent.z * normal.size.z);
}

}  // namespace lamina::csg
