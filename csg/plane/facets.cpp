#include "csg/plane/facets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "csg/degrees.h"
#include "csg/limits.h"

namespace lamina::planar {
namespace {

// Below this radius [mm] OpenSCAD takes anything for a point.
constexpr double kSmallestRadius = 0.00000095367431640625;

// A slice that turns by more than a third of a circle is no longer a solid.
constexpr double kGreatestTwistPerSlice = 120;

int to_count(double x) {
  csg::require_fragments(x);
  return static_cast<int>(x);
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

int twisted_slice_count(const csg::LinearExtrudeParams& params,
                        double max_radius) {
  const double twist_deg = std::abs(params.twist_deg);
  const double fn = params.facets.fn;
  const int least =
      std::max(ceil_to_slices(twist_deg / kGreatestTwistPerSlice), 1);
  if (max_radius < kSmallestRadius || !std::isfinite(fn)) return least;
  if (fn > 0) return std::max(ceil_to_slices(twist_deg / 360 * fn), least);
  const double twist = twist_deg * std::numbers::pi / 180;
  const bool is_cone = params.scale.x == params.scale.y && params.scale.x != 1;
  const double length = is_cone
                            ? conical_helix_length(max_radius, params.height,
                                                   twist, params.scale.x)
                            : helix_length(max_radius, params.height, twist);
  const int by_angle = ceil_to_slices(twist_deg / params.facets.fa);
  const int by_length = ceil_to_slices(length / params.facets.fs);
  return std::max(std::min(by_angle, by_length), least);
}

}  // namespace

int fragment_count(double r, const csg::Facets& facets) {
  if (r < kSmallestRadius || !std::isfinite(facets.fn)) return 3;
  if (facets.fn > 0) return to_count(std::max(facets.fn, 3.0));
  const double by_angle = 360 / facets.fa;
  const double by_length = r * 2 * std::numbers::pi / facets.fs;
  return to_count(std::ceil(std::fmax(std::fmin(by_angle, by_length), 5)));
}

int curve_segment_count(double size, const csg::Facets& facets) {
  return std::max(fragment_count(size, facets) / 8 + 1, 2);
}

std::vector<Vec2> unit_circle(int n) {
  std::vector<Vec2> points(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    const double angle_deg = 360.0 * i / n;
    points[static_cast<std::size_t>(i)] = {csg::cos_deg(angle_deg),
                                           csg::sin_deg(angle_deg)};
  }
  return points;
}

int slice_count(const csg::LinearExtrudeParams& params, double max_radius,
                double max_shift) {
  if (params.has_twist) return twisted_slice_count(params, max_radius);
  if (params.scale.x == params.scale.y) return 1;
  const double fn = params.facets.fn;
  if (max_shift < kSmallestRadius || !std::isfinite(fn)) return 1;
  if (fn > 0) return std::max(to_slices(fn), 1);
  const double length =
      std::sqrt(max_shift * max_shift + params.height * params.height);
  return std::max(ceil_to_slices(length / params.facets.fs), 1);
}

}  // namespace lamina::planar
