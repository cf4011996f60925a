// Lawson's flips, pass by pass over the edges next to the last ones.

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "plane/predicates.h"
#include "plane/region/triangulate.h"

namespace lamina::plane {
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
      : points_(points),
        triangles_(triangles),
        last_flip_(triangles.size(), kNever) {
    for (std::size_t i = 0; i < triangles_.size(); ++i) list_sides(i);
    for (const auto& [edge, side] : sides_) {
      if (edge.first < edge.second) changed_.push_back(edge);
    }
  }

  // One pass over the edges of triangles that the last pass flipped: no other
  // edge can have become the worse diagonal. Every triangle takes part in one
  // flip at most. Returns whether any was done.
  bool flip_changed() {
    const std::vector<Edge> edges = take_changed();
    for (const Edge& edge : edges) {
      const auto side = sides_.find(edge);
      const auto twin = sides_.find({edge.second, edge.first});
      if (side == sides_.end() || twin == sides_.end()) continue;
      flip_if_better(side->second, twin->second);
    }
    ++pass_;
    return !changed_.empty();
  }

 private:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;  // of points

  static constexpr std::size_t kNever = static_cast<std::size_t>(-1);

  void list_sides(std::size_t triangle) {
    for (std::size_t k = 0; k < 3; ++k) {
      sides_[{corner(triangle, k + 1), corner(triangle, k + 2)}] = {triangle,
                                                                    k};
    }
  }

  // Sorted, each once.
  std::vector<Edge> take_changed() {
    std::vector<Edge> edges = std::exchange(changed_, {});
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
  }

  std::uint32_t corner(std::size_t triangle, std::size_t k) const {
    return triangles_[triangle][k % 3];
  }

  void flip_if_better(Side side, Side other) {
    if (last_flip_[side.triangle] == pass_ ||
        last_flip_[other.triangle] == pass_ || !should_flip(side, other)) {
      return;
    }
    flip(side, other);
    for (const std::size_t triangle : {side.triangle, other.triangle}) {
      last_flip_[triangle] = pass_;
      for (std::size_t k = 0; k < 3; ++k) {
        changed_.push_back(
            std::minmax({corner(triangle, k), corner(triangle, k + 1)}));
      }
    }
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
    sides_.erase({a, b});
    sides_.erase({b, a});
    list_sides(side.triangle);
    list_sides(other.triangle);
  }

  std::span<const Vec2> points_;
  std::vector<Triangle>& triangles_;
  std::map<Edge, Side> sides_;
  std::vector<Edge> changed_;  // the lesser point first
  std::size_t pass_ = 0;
  std::vector<std::size_t> last_flip_;  // by triangle: in which pass
};

}  // namespace

void make_delaunay(std::span<const Vec2> points,
                   std::vector<Triangle>& triangles) {
  // Flips make angles grow, so they end; the cap is for rounding.
  Flipper flipper(points, triangles);
  for (std::size_t i = 0; i < 4 * triangles.size() && flipper.flip_changed();
       ++i) {
  }
}

}  // namespace lamina::plane
