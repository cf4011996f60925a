#pragma once
// On which side of a plane a point of space lies, exactly.
//
// Source: filter and expansions as in Shewchuk, "Adaptive precision
// floating-point arithmetic and fast robust geometric predicates", 1997.

#include "base/vec.h"

namespace lamina::csg {

// +1 where d lies above the plane of a, b, c, from where they run
// counter-clockwise; -1 below; 0 in the plane, or where a, b, c are on one
// line. Exact for coordinates whose products of three neither overflow nor
// underflow, such as multiples of 2^-300 below 2^300.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

// A plane of which many points are asked.
class OrientedPlane {
 public:
  OrientedPlane() = default;
  // a, b, c  not on one line
  // extent   of a box around all points that are asked, and these
  OrientedPlane(const Vec3& a, const Vec3& b, const Vec3& c,
                const Vec3& extent);

  // Grows with the distance of d above the plane. It has the sign of
  // orientation(a, b, c, d) where it exceeds rounding() or is below
  // -rounding().
  double height(const Vec3& d) const {
    const Vec3 away = d - corner_;
    return away.x * normal_.x + away.y * normal_.y + away.z * normal_.z;
  }
  double rounding() const { return rounding_; }

 private:
  Vec3 corner_ = Vec3(0);
  Vec3 normal_ = Vec3(0);
  double rounding_ = 0;
};

}  // namespace lamina::csg
