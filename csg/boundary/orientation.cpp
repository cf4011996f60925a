#include "csg/boundary/detail/orientation.h"

#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/exact_sum.h"

namespace lamina::csg {
namespace {

// Bounds the error of the determinant as a share of the sum of its products'
// sizes. With u half of epsilon it is (7 + 56 u) u, Shewchuk's o3derrboundA.
constexpr double kRelativeError = 4 * std::numeric_limits<double>::epsilon();

// (b - a) × (c - a), and for each coordinate the sum of its products' sizes.
struct Normal {
  Normal(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 u = b - a;
    const Vec3 v = c - a;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const int k = (i + 2) % 3;
      const double left = u[j] * v[k];
      const double right = u[k] * v[j];
      value[i] = left - right;
      size[i] = std::abs(left) + std::abs(right);
    }
  }

  Vec3 value;
  Vec3 size;
};

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
  const Normal normal(a, b, c);
  const Vec3 away = d - a;
  const double sum = away.x * normal.value.x + away.y * normal.value.y +
                     away.z * normal.value.z;
  // Nothing is rounded where all products are 0.
  const double size = glm::dot(glm::abs(away), normal.size);
  if (std::abs(sum) >= kRelativeError * size) return sign(sum);
  return find_exact_sign(a, b, c, d);
}

OrientedPlane::OrientedPlane(const Vec3& a, const Vec3& b, const Vec3& c,
                             const Vec3& extent)
    : corner_(a) {
  const Normal normal(a, b, c);
  normal_ = normal.value;
  rounding_ =
      kRelativeError * (extent.x * normal.size.x + extent.y * normal.size.y +
                        extent.z * normal.size.z);
}

}  // namespace lamina::csg
