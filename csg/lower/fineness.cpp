#include "csg/lower/detail/fineness.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "csg/facets.h"
#include "csg/limits.h"

namespace lamina::csg {
namespace {

using std::numbers::pi;

// OpenSCAD's least number of sides where $fn does not say.
constexpr int kFewest = 5;

int to_count(double x) {
  require_fragments(x);
  return static_cast<int>(std::max(std::ceil(x), 1.0));
}

// The angle whose chord in a circle of radius r has this height. [rad]
double chord_angle(double r, double height) {
  return 2 * std::acos(std::max(1 - height / r, -1.0));
}

int circle_fragments_within(double r, double error) {
  return std::max(to_count(2 * pi / chord_angle(r, error)), kFewest);
}

// Distance of a sphere's facets from it. The worst ones lie beside the
// equator: across, their sides span 2π/n; along, π/rings. With an odd number
// of rings one ring is the equator itself.
double sphere_error(double r, int n) {
  const int rings = (n + 1) / 2;
  const double across = pi / n;
  const double step = pi / rings;
  if (rings % 2 == 0) return r * (1 - std::cos(across) * std::cos(step / 2));
  const Vec2 low(std::cos(across), 0);
  const Vec2 high(std::cos(across) * std::cos(step), std::sin(step));
  const Vec2 along = high - low;
  const double facet = std::abs(low.x * along.y) / glm::length(along);
  // The poles are cut off.
  return r * std::max(1 - facet, 1 - std::cos(step / 2));
}

// In slice i of n every edge e of the outline is carried to another, e'. Both
// triangles between them leave the ruled surface that they stand for by
// |e' − e| / 4, a share of the edge's length; the paths of the edge's ends,
// p(t) = scale(t)·turn(t)·p over t in [0, 1], leave their chords by
// |p''| / (8 n²).
ExtrusionSteps steps_within(const LinearExtrudeParams& params,
                            double max_radius, double error) {
  const double turn = std::abs(params.twist_deg) * pi / 180;
  const double greatest =
      std::max({1.0, std::abs(params.scale.x), std::abs(params.scale.y)});
  const double growth =
      std::max(std::abs(1 - params.scale.x), std::abs(1 - params.scale.y));
  const double bend = max_radius * (greatest * turn * turn + 2 * growth * turn);
  const double change = greatest * turn + growth;
  // A half for the paths, a half for the faces between.
  const double for_paths = std::sqrt(bend / (8 * error / 2));
  // As many slices as an edge across the whole outline has parts.
  const double for_faces = std::sqrt(change * max_radius / (4 * error / 2));
  constexpr double kGreatestTurn = 2 * pi / 3;
  ExtrusionSteps steps;
  steps.slices = to_count(
      std::max({turn == 0 ? for_faces : for_paths, turn / kGreatestTurn, 1.0}));
  if (change > 0) steps.longest_edge = 4 * (error / 2) * steps.slices / change;
  return steps;
}

}  // namespace

int circle_fragments(double r, const Fineness& fineness) {
  if (!fineness.is_by_error()) {
    return csg::fragment_count(r, fineness.facets, fineness.language);
  }
  return circle_fragments_within(r, fineness.chordal_error);
}

int sphere_fragments(double r, const Fineness& fineness) {
  if (!fineness.is_by_error()) {
    return csg::fragment_count(r, fineness.facets, fineness.language);
  }
  // About π²/n² of the radius; a little fewer to begin with.
  const double error = fineness.chordal_error;
  int n = std::max(to_count(0.9 * pi / std::sqrt(error / r)), kFewest);
  while (sphere_error(r, n) > error) require_fragments(++n);
  return n;
}

int turn_fragments(const ProfileRange& range, double angle_deg,
                   const Fineness& fineness) {
  const double angle = std::abs(angle_deg);
  if (fineness.is_by_error()) {
    const double r = std::max(range.high, -range.low);
    return std::max(
        to_count(circle_fragments_within(r, fineness.chordal_error) * angle /
                 360),
        1);
  }
  return csg::fragment_count(range.high - range.low, fineness.facets,
                             fineness.language, angle);
}

double arc_step_deg(double r, const Fineness& fineness) {
  const Facets& facets = fineness.facets;
  if (facets.fn > 0) return 360 / std::clamp(facets.fn, 3.0, kMostFragments);
  const double step = fineness.is_by_error()
                          ? chord_angle(r, fineness.chordal_error) * 180 / pi
                          : std::min(facets.fa, facets.fs / r * 180 / pi);
  require_fragments(360 / step);
  return std::min(step, 120.0);
}

ExtrusionSteps extrusion_steps(const LinearExtrudeParams& params,
                               double max_radius, double max_shift,
                               const Fineness& fineness) {
  if (params.slices > 0) return {params.slices};
  if (fineness.is_by_error()) {
    return steps_within(params, max_radius, fineness.chordal_error);
  }
  return {csg::slice_count(params, max_radius, max_shift, fineness.language)};
}

double greatest_stretch(const Affine& map) {
  // The greatest row sum of MᵀM bounds its greatest eigenvalue.
  double bound = 0;
  for (int i = 0; i < 3; ++i) {
    double sum = 0;
    for (int j = 0; j < 3; ++j) sum += std::abs(glm::dot(map[i], map[j]));
    bound = std::max(bound, sum);
  }
  // Rounded up, but for what rounding can have added, so that it is the same
  // for copies that are only turned.
  constexpr double kUnits = 0x1p40;
  int exponent = 0;
  const double mantissa = std::frexp(std::sqrt(bound), &exponent);
  return std::ldexp(std::ceil((mantissa - 1e-13) * kUnits) / kUnits, exponent);
}

}  // namespace lamina::csg
