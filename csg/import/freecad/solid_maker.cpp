#include "csg/import/freecad/detail/solid_maker.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "csg/degrees.h"
#include "csg/limits.h"

namespace lamina::csg::freecad {
namespace {

// For which the nearest facets of a sphere, beside its equator, are off by
// error: about (pi / fragments)² of the radius.
int sphere_fragments(double radius, double error) {
  const double least = std::numbers::pi * std::sqrt(radius / error) + 1;
  require_fragments(least);
  return std::max(8, static_cast<int>(std::ceil(least)));
}

Facets facets_of(int fragments) {
  Facets facets;
  facets.fn = fragments;
  return facets;
}

}  // namespace

// --- Nodes ------------------------------------------------------------------

Solid SolidMaker::make(decltype(Node::op) op, std::span<const Solid> children) {
  std::vector<const Node*> nodes;
  std::size_t leaves = children.empty() ? 1 : 0;
  for (const Solid& child : children) {
    nodes.push_back(child.node);
    leaves += child.leaves;
    if (leaves > most_leaves_) {
      throw plane::LimitExceeded(fmt::format(
          "Too many leaves: more than the {} that --max-leaves allows",
          most_leaves_));
    }
  }
  Node* const node = arena_.make(Node());
  node->op = op;
  node->children = arena_.copy(std::span<const Node* const>(nodes));
  node->range = origin_.range;
  node->caller = origin_.caller;
  return {node, leaves};
}

Solid SolidMaker::leaf(decltype(Node::op) op) { return make(op, {}); }

Solid SolidMaker::unite(std::span<const Solid> solids) {
  return solids.size() == 1 ? solids.front() : make(Union(), solids);
}

Solid SolidMaker::intersect(std::span<const Solid> solids) {
  return solids.size() == 1 ? solids.front() : make(Intersection(), solids);
}

Solid SolidMaker::subtract(std::span<const Solid> solids) {
  return solids.size() == 1 ? solids.front() : make(Difference(), solids);
}

Solid SolidMaker::place(const Mat4& world_from_solid, const Solid& solid) {
  const auto* const inner = std::get_if<Transform>(&solid.node->op);
  const Mat4 matrix =
      inner != nullptr ? world_from_solid * *inner->matrix : world_from_solid;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (plane::is_too_far(matrix[column][row])) plane::fail_too_far();
    }
  }
  const Solid child = inner != nullptr
                          ? Solid{solid.node->children.front(), solid.leaves}
                          : solid;
  if (matrix == Mat4(1)) return child;
  return make(Transform{arena_.make(matrix)}, {&child, 1});
}

// --- Solids -----------------------------------------------------------------

Solid SolidMaker::polygon(const std::vector<Polyline>& contours) {
  std::vector<Vec2> points;
  std::vector<std::span<const std::uint32_t>> paths;
  for (const Polyline& contour : contours) {
    std::vector<std::uint32_t> path;
    for (const Vec2 corner : contour) {
      path.push_back(static_cast<std::uint32_t>(points.size()));
      if (plane::is_too_far(corner.x) || plane::is_too_far(corner.y))
        plane::fail_too_far();
      points.push_back(corner);
    }
    plane::require_corners(corners_ += contour.size());
    paths.push_back(arena_.copy(std::span<const std::uint32_t>(path)));
  }
  PolygonParams params;
  params.points = arena_.copy(std::span<const Vec2>(points));
  if (paths.size() > 1) {
    params.paths =
        arena_.copy(std::span<const std::span<const std::uint32_t>>(paths));
  }
  return leaf(Polygon{keep(params)});
}

Solid SolidMaker::extrude(const Outline& outline, Vec3 way, double from,
                          double to) {
  const Vec3 normal = apply_to_way(outline.plane, Vec3(0, 0, 1));
  Vec3 step = glm::normalize(way);
  if (glm::dot(step, normal) < 0) {
    step = -step;
    from = -from;
    to = -to;
  }
  const auto [low, high] = std::minmax(from, to);
  // Along the normal the prism is as high as `step` leads away from the plane.
  const double rise = glm::dot(step, normal);
  Mat4 matrix = outline.plane;
  constexpr double kUpright = 1e-12;
  if (rise < 1 - kUpright) matrix[2] = Vec4(step / rise, 0);
  matrix[3] += Vec4(low * step, 0);
  LinearExtrudeParams params;
  params.height = (high - low) * rise;
  if (plane::is_too_far(params.height)) plane::fail_too_far();
  const Solid base = polygon(outline.contours);
  return place(matrix, make(LinearExtrude{keep(params)}, {&base, 1}));
}

Solid SolidMaker::revolve(const std::vector<Polyline>& contours,
                          double angle_deg) {
  double radius = 0;
  for (const Polyline& contour : contours) {
    for (const Vec2 corner : contour) radius = std::max(radius, corner.x);
  }
  RotateExtrude op;
  op.angle_deg = angle_deg;
  op.facets =
      facets_of(circle_chords(radius, error_ - chordal_error_of_turned()));
  if (angle_deg == 360) op.start_deg = 180;
  const Solid base = polygon(contours);
  return make(op, {&base, 1});
}

Solid SolidMaker::cylinder(double height, double bottom_radius,
                           double top_radius) {
  const double radius = std::max(bottom_radius, top_radius);
  return leaf(Cylinder{height, bottom_radius, top_radius, false,
                       facets_of(circle_chords(radius, error_))});
}

Solid SolidMaker::sphere(double radius) {
  return leaf(Sphere{radius, facets_of(sphere_fragments(radius, error_))});
}

// --- Matrices ---------------------------------------------------------------

Mat4 turn_about_z(double angle_deg) {
  const double c = cos_deg(angle_deg);
  const double s = sin_deg(angle_deg);
  Mat4 matrix(1);
  matrix[0] = Vec4(c, s, 0, 0);
  matrix[1] = Vec4(-s, c, 0, 0);
  return matrix;
}

Mat4 mirror(Vec3 base, Vec3 normal) {
  const Vec3 n = glm::normalize(normal);
  Mat4 matrix(1);
  for (int i = 0; i < 3; ++i) matrix[i] -= Vec4(2 * n[i] * n, 0);
  matrix[3] = Vec4(2 * glm::dot(base, n) * n, 1);
  return matrix;
}

Vec3 apply_to_point(const Mat4& matrix, Vec3 point) {
  return Vec3(matrix * Vec4(point, 1));
}

Vec3 apply_to_way(const Mat4& matrix, Vec3 way) {
  return Vec3(matrix * Vec4(way, 0));
}

}  // namespace lamina::csg::freecad
