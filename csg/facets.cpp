#include "csg/facets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "csg/degrees.h"
#include "csg/limits.h"

namespace lamina::csg {
namespace {

// Below this radius [mm] OpenSCAD takes anything for a point.
constexpr double kSmallestRadius = 0.00000095367431640625;

// A slice that turns by more than a third of a circle is no longer a solid.
constexpr double kGreatestTwistPerSlice = 120;

// $fa and $fs at their least bound the sides that $fe asks for.
constexpr double kLeastAngle = 0.01;
constexpr double kLeastLength = 0.01;
// OpenSCAD's least number of sides where $fn does not say.
constexpr double kFewest = 5;

int to_count(double x) {
  require_fragments(x);
  return static_cast<int>(x);
}

double count_by_size(double r, double fa, double fs) {
  const double by_angle = 360 / fa;
  const double by_length = r * 2 * std::numbers::pi / fs;
  return std::fmax(std::fmin(by_angle, by_length), kFewest);
}

// As few sides as stay within `error` of the circle; not a whole number.
double count_by_error(double r, double error) {
  // From here on five sides do.
  if (error / r >= 1 - std::cos(std::numbers::pi / kFewest)) return kFewest;
  return std::min(std::numbers::pi / std::acos(1 - error / r),
                  count_by_size(r, kLeastAngle, kLeastLength));
}

int fragment_count_2021(double r, const Facets& facets, double angle_deg) {
  int n = 3;
  if (r >= kSmallestRadius && std::isfinite(facets.fn)) {
    n = facets.fn > 0
            ? to_count(std::max(facets.fn, 3.0))
            : to_count(std::ceil(count_by_size(r, facets.fa, facets.fs)));
  }
  return static_cast<int>(n * angle_deg / 360);
}

int fragment_count_2026(double r, const Facets& facets, double angle_deg) {
  const double share = angle_deg / 360;
  if (r < kSmallestRadius || !std::isfinite(facets.fn) ||
      !std::isfinite(facets.fe)) {
    return static_cast<int>(3 * share);
  }
  double n = 0;
  if (facets.fn > 0) {
    // Multiplied before it is divided, for OpenSCAD's bits.
    n = std::ceil(std::max(facets.fn, 3.0)) * angle_deg / 360;
  } else if (facets.fe >= kSmallestRadius) {
    n = count_by_error(r, facets.fe) * share;
  } else {
    n = std::ceil(count_by_size(r, facets.fa, facets.fs)) * share;
  }
  return to_count(std::ceil(n));
}

// More slices than an int can count, as $fs = 0 asks for, count as none.
int to_slices(double x) {
  return std::abs(x) <= std::numeric_limits<int>::max() ? static_cast<int>(x)
                                                        : 0;
}
int ceil_to_slices(double x) { return to_slices(std::ceil(x)); }

// Length of the helix that a vertex follows [mm].
double helix_length(double radius, double height, double twist) {
  return std::sqrt(radius * radius * twist * twist + height * height);
}

// Length from the pole of the Archimedean spiral r = a·t to the angle t.
double spiral_length(double a, double t) {
  return 0.5 * a * (t * std::sqrt(1 + t * t) + std::asinh(t));
}

// Length of the conical helix: a piece of a spiral in plan, rising evenly.
double conical_helix_length(double radius, double height, double twist,
                            double scale) {
  const double end =
      scale > 1 ? twist * scale / (scale - 1) : twist / (1 - scale);
  const double a = radius / end;
  const double plan = spiral_length(a, end) - spiral_length(a, end - twist);
  return std::sqrt(plan * plan + height * height);
}

// As few slices as keep chords of the helix within `error` of it. A chord that
// turns by t lies r (1 - cos(t / 2)) closer to the axis than the helix.
int slice_count_by_error(double radius, double twist, double error) {
  if (error >= radius) return 1;
  return ceil_to_slices(twist / (2 * std::acos(1 - error / radius)));
}

int twisted_slice_count(const LinearExtrudeParams& params, double max_radius) {
  const double twist_deg = std::abs(params.twist_deg);
  const double fn = params.facets.fn;
  const int least =
      std::max(ceil_to_slices(twist_deg / kGreatestTwistPerSlice), 1);
  if (max_radius < kSmallestRadius || !std::isfinite(fn)) return least;
  if (fn > 0) return std::max(ceil_to_slices(twist_deg / 360 * fn), least);
  const double twist = twist_deg * std::numbers::pi / 180;
  const bool is_cone = params.scale.x == params.scale.y && params.scale.x != 1;
  if (params.facets.fe > 0 && !is_cone) {
    return std::max(slice_count_by_error(max_radius, twist, params.facets.fe),
                    least);
  }
  const double length = is_cone
                            ? conical_helix_length(max_radius, params.height,
                                                   twist, params.scale.x)
                            : helix_length(max_radius, params.height, twist);
  const int by_angle = ceil_to_slices(twist_deg / params.facets.fa);
  const int by_length = ceil_to_slices(length / params.facets.fs);
  return std::max(std::min(by_angle, by_length), least);
}

}  // namespace

int fragment_count(double r, const Facets& facets, Language language,
                   double angle_deg) {
  return std::max(language == Language::k2021
                      ? fragment_count_2021(r, facets, angle_deg)
                      : fragment_count_2026(r, facets, angle_deg),
                  1);
}

int curve_segment_count(double size, const Facets& facets, Language language) {
  return std::max(fragment_count(size, facets, language) / 8 + 1, 2);
}

std::vector<Vec2> unit_circle(int n) {
  std::vector<Vec2> points(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    const double angle_deg = 360.0 * i / n;
    points[static_cast<std::size_t>(i)] = {cos_deg(angle_deg),
                                           sin_deg(angle_deg)};
  }
  return points;
}

plane::Region square(Vec2 size, bool center) {
  if (!(size.x > 0 && size.y > 0) || std::isinf(size.x) || std::isinf(size.y)) {
    return {};
  }
  const Vec2 low = center ? -size / 2.0 : Vec2(0);
  const Vec2 high = center ? size / 2.0 : size;
  return {{{low, {high.x, low.y}, high, {low.x, high.y}}}};
}

plane::Region circle(double r, int fragments) {
  if (!(r > 0) || std::isinf(r)) return {};
  plane::Contour contour = unit_circle(fragments);
  for (Vec2& point : contour) point *= r;
  return {{std::move(contour)}};
}

namespace {

// Of an extrusion whose top is scaled, unevenly and without a twist.
int scaled_slice_count(const LinearExtrudeParams& params, double max_shift) {
  const double fn = params.facets.fn;
  if (max_shift < kSmallestRadius || !std::isfinite(fn)) return 1;
  if (fn > 0) return std::max(to_slices(fn), 1);
  const double length =
      std::sqrt(max_shift * max_shift + params.height * params.height);
  return std::max(ceil_to_slices(length / params.facets.fs), 1);
}

}  // namespace

int slice_count(const LinearExtrudeParams& params, double max_radius,
                double max_shift, Language language) {
  const bool is_uneven = params.scale.x != params.scale.y;
  const int by_scale = is_uneven ? scaled_slice_count(params, max_shift) : 1;
  if (!params.has_twist) return by_scale;
  const int by_twist = twisted_slice_count(params, max_radius);
  // 2021.01 does not look at the scale then.
  return language == Language::k2021 ? by_twist : std::max(by_twist, by_scale);
}

}  // namespace lamina::csg
