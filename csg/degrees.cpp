#include "csg/degrees.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace lamina::csg {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

// Beyond 2^52 turns a double no longer distinguishes fractions of a turn.
constexpr double kLargestAngle = 360.0 * 4503599627370496.0;

// Both of angles in [0, 90].
double sin_first_quadrant(double angle_deg) {
  if (angle_deg == 30) return 0.5;
  if (angle_deg == 45) return std::numbers::sqrt2 / 2;
  if (angle_deg == 60) return std::numbers::sqrt3 / 2;
  return angle_deg < 45 ? std::sin(angle_deg * kRadiansPerDegree)
                        : std::cos((90 - angle_deg) * kRadiansPerDegree);
}
double cos_first_quadrant(double angle_deg) {
  if (angle_deg == 30) return std::numbers::sqrt3 / 2;
  if (angle_deg == 45) return std::numbers::sqrt2 / 2;
  if (angle_deg == 60) return 0.5;
  return angle_deg < 45 ? std::cos(angle_deg * kRadiansPerDegree)
                        : std::sin((90 - angle_deg) * kRadiansPerDegree);
}

// In [0, 360); NaN where that is not known.
double fold_turns(double angle_deg) {
  if (angle_deg >= 0 && angle_deg < 360) return angle_deg;
  if (!(std::abs(angle_deg) < kLargestAngle)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return angle_deg - 360 * std::floor(angle_deg / 360);
}

}  // namespace

double sin_deg(double angle_deg) {
  double a = fold_turns(angle_deg);
  const bool is_lower_half = a >= 180;
  if (is_lower_half) a -= 180;
  if (a > 90) a = 180 - a;
  const double s = sin_first_quadrant(a);
  return is_lower_half ? -s : s;
}

double cos_deg(double angle_deg) {
  double a = fold_turns(angle_deg);
  bool is_left_half = a >= 180;
  if (is_left_half) a -= 180;
  if (a > 90) {
    a = 180 - a;
    is_left_half = !is_left_half;
  }
  const double c = cos_first_quadrant(a);
  return is_left_half ? -c : c;
}

double atan2_deg(double y, double x) {
  constexpr double kRounding = 3.0E-14;  // OpenSCAD's, in degrees
  const double degrees = std::atan2(y, x) * (180.0 / std::numbers::pi);
  const double whole = std::round(degrees);
  return std::fabs(degrees - whole) < kRounding ? whole : degrees;
}

}  // namespace lamina::csg
