// Lawson's flips, pass by pass over all edges.

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "base/plane.h"
#include "csg/plane/triangulate.h"

namespace lamina::planar {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

// Four points on a circle have two triangulations that are equally good:
// rounding must not choose. OpenSCAD's tessellator has the same [rad].
constexpr double kAngleSlack = 0.01;

// A side of a triangle: the corner opposite to it names it.
struct Side {
  std::size_t triangle = 0;
  std::size_t corner = 0;
};

double angle_at(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 u = a - p;
  const Vec2 v = b - p;
  return std::atan2(std::abs(cross(u, v)), dot(u, v));
}

class Flipper {
 public:
  Flipper(std::span<const Vec2> points, std::vector<Triangle>& triangles)
      : points_(points), triangles_(triangles) {}

  // One pass; every triangle takes part in one flip at most, so that the
  // sides found at its beginning stay valid. Returns whether any was done.
  bool flip_all() {
    const auto sides = find_sides();
    std::vector<bool> is_touched(triangles_.size(), false);
    bool any = false;
    for (const auto& [edge, side] : sides) {
      const auto twin = sides.find({edge.second, edge.first});
      if (edge.first > edge.second || twin == sides.end()) continue;
      const Side other = twin->second;
      if (is_touched[side.triangle] || is_touched[other.triangle]) continue;
      if (!should_flip(side, other)) continue;
      flip(side, other);
      is_touched[side.triangle] = is_touched[other.triangle] = true;
      any = true;
    }
    return any;
  }

 private:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;

  std::map<Edge, Side> find_sides() const {
    std::map<Edge, Side> sides;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        sides[{corner(i, k + 1), corner(i, k + 2)}] = {i, k};
      }
    }
    return sides;
  }

  std::uint32_t corner(std::size_t triangle, std::size_t k) const {
    return triangles_[triangle][k % 3];
  }

  bool should_flip(Side side, Side other) const {
    const Vec2 p = points_[corner(side.triangle, side.corner)];
    const Vec2 a = points_[corner(side.triangle, side.corner + 1)];
    const Vec2 b = points_[corner(side.triangle, side.corner + 2)];
    const Vec2 q = points_[corner(other.triangle, other.corner)];
    const bool is_convex = orientation(p, a, q) > 0 && orientation(q, b, p) > 0;
    return is_convex && angle_at(p, a, b) + angle_at(q, a, b) >=
                            std::numbers::pi + kAngleSlack;
  }

  void flip(Side side, Side other) {
    const std::uint32_t p = corner(side.triangle, side.corner);
    const std::uint32_t a = corner(side.triangle, side.corner + 1);
    const std::uint32_t b = corner(side.triangle, side.corner + 2);
    const std::uint32_t q = corner(other.triangle, other.corner);
    triangles_[side.triangle] = {p, a, q};
    triangles_[other.triangle] = {p, q, b};
  }

  std::span<const Vec2> points_;
  std::vector<Triangle>& triangles_;
};

}  // namespace

void make_delaunay(std::span<const Vec2> points,
                   std::vector<Triangle>& triangles) {
  // Flips make angles grow, so they end; the cap is for rounding.
  Flipper flipper(points, triangles);
  for (std::size_t i = 0; i < 4 * triangles.size() && flipper.flip_all(); ++i) {
  }
}

}  // namespace lamina::planar
