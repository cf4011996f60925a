#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>

#include "base/vec.h"
#include "csg/minkowski/convex.h"
#include "plane/predicates.h"
#include "plane/region/minkowski.h"

namespace lamina::csg {
namespace {

using Edge = Convex::Edge;

constexpr std::uint32_t kNone = ~std::uint32_t{0};

Vec2 unit(Vec2 v) {
  const double length = std::hypot(v.x, v.y);
  return length > 0 ? v / length : Vec2(1, 0);
}

// Merges the normals of a body with those of a flat one. Letters: `corner` is
// of the flat body's polygon, `vertex` of the other body.
class FlatSum {
 public:
  FlatSum(const Convex& flat, const Convex& body)
      : polygon_(flat.vertices), body_(body), normal_(flat.normals[0]) {}

  Convex make() {
    lay_out();
    aim_facets();
    turns_.assign(body_.vertices.size(), 0);
    names_.assign(body_.vertices.size() * corner_count(), kNone);
    for (std::size_t f = 0; f < body_.facet_count(); ++f) move_facet(f);
    for (const Edge& edge : body_.edges) sweep_edge(edge);
    for (std::uint32_t v = 0; v < turns_.size(); ++v) carry_polygon(v);
    return std::move(sum_);
  }

 private:
  std::uint32_t corner_count() const {
    return static_cast<std::uint32_t>(polygon_.size());
  }

  // Puts the polygon into a plane, and its sides' outward normals.
  void lay_out() {
    std::size_t longest = 0;
    std::vector<Vec3> sides;
    for (std::size_t i = 0; i < polygon_.size(); ++i) {
      sides.push_back(polygon_[i + 1 == polygon_.size() ? 0 : i + 1] -
                      polygon_[i]);
      if (glm::length(sides[i]) > glm::length(sides[longest])) longest = i;
    }
    x_axis_ = glm::normalize(sides[longest]);
    y_axis_ = glm::cross(normal_, x_axis_);
    for (std::size_t i = 0; i < polygon_.size(); ++i) {
      plan_.push_back(project(polygon_[i] - polygon_[0]));
      const Vec2 side = project(sides[i]);
      side_normals_.push_back(unit({side.y, -side.x}));
    }
  }
  Vec2 project(const Vec3& v) const {
    return {glm::dot(v, x_axis_), glm::dot(v, y_axis_)};
  }

  // Finds the corner that lies farthest along each facet's normal. Where the
  // normal is the polygon's own all are equally far, and any direction does.
  void aim_facets() {
    for (const Vec3& normal : body_.normals) {
      const Vec2 aim = unit(project(normal));
      std::uint32_t farthest = 0;
      for (std::uint32_t i = 1; i < corner_count(); ++i) {
        if (glm::dot(aim, plan_[i]) > glm::dot(aim, plan_[farthest])) {
          farthest = i;
        }
      }
      aims_.push_back(aim);
      farthest_.push_back(farthest);
    }
  }

  std::uint32_t name(std::uint32_t vertex, std::uint32_t corner) {
    std::uint32_t& id = names_[std::size_t{vertex} * corner_count() + corner];
    if (id == kNone) {
      id = static_cast<std::uint32_t>(sum_.vertices.size());
      sum_.vertices.push_back(body_.vertices[vertex] + polygon_[corner]);
    }
    return id;
  }

  void move_facet(std::size_t facet) {
    loop_.clear();
    for (const std::uint32_t vertex : body_.facet(facet)) {
      loop_.push_back(name(vertex, farthest_[facet]));
    }
    if (loop_.size() > 2) sum_.add_facet(loop_, body_.normals[facet]);
  }

  std::uint32_t step(std::uint32_t corner, bool is_forward) const {
    if (is_forward) return corner + 1 == corner_count() ? 0 : corner + 1;
    return corner == 0 ? corner_count() - 1 : corner - 1;
  }

  // The least share that the sides on the way from corner to corner have of a
  // direction.
  double least_share(std::uint32_t from, std::uint32_t to, bool is_forward,
                     Vec2 direction) const {
    double least = std::numeric_limits<double>::max();
    while (from != to) {
      const std::uint32_t next = step(from, is_forward);
      least = std::min(
          least, glm::dot(side_normals_[is_forward ? from : next], direction));
      from = next;
    }
    return least;
  }

  // Which way round the polygon leads from the right facet's corner to the
  // left one's: the way that the normal turns. Where the two aims are less
  // than a right angle apart the normals of the right way's sides lie between
  // them, while on the wrong way some side faces back: no rounding can confuse
  // the two. Where the aims are opposite, up to rounding, the edge lies in the
  // polygon's plane and either way does.
  bool goes_forward(const Edge& edge) const {
    const Vec2 from = aims_[edge.right];
    const Vec2 to = aims_[edge.left];
    if (glm::dot(from, to) <= 0) return cross(from, to) > 0;
    const std::uint32_t start = farthest_[edge.right];
    const std::uint32_t end = farthest_[edge.left];
    return least_share(start, end, true, from + to) >
           least_share(start, end, false, from + to);
  }

  void sweep_edge(const Edge& edge) {
    const std::uint32_t end = farthest_[edge.left];
    std::uint32_t corner = farthest_[edge.right];
    if (corner == end) return;
    const bool is_forward = goes_forward(edge);
    while (corner != end) {
      const std::uint32_t next = step(corner, is_forward);
      const std::array loop{name(edge.to, next), name(edge.from, next),
                            name(edge.from, corner), name(edge.to, corner)};
      sum_.add_facet(loop,
                     swept_normal(edge, polygon_[next] - polygon_[corner]));
      turns_[edge.from] += is_forward ? 1 : -1;
      turns_[edge.to] -= is_forward ? 1 : -1;
      corner = next;
    }
  }

  // The normal between those of the edge's facets that stands on the side.
  Vec3 swept_normal(const Edge& edge, const Vec3& side) const {
    const Vec3& right = body_.normals[edge.right];
    const Vec3& left = body_.normals[edge.left];
    const double right_share = std::max(glm::dot(left, side), 0.0);
    const double left_share = std::max(-glm::dot(right, side), 0.0);
    const Vec3 normal = right_share * right + left_share * left;
    const double length = glm::length(normal);
    if (length > 0) return normal / length;
    const Vec3 between = right + left;
    const double size = glm::length(between);
    return size > 0 ? between / size : right;
  }

  // Where the ways around a vertex turn about the polygon, the polygon is a
  // facet of the sum.
  void carry_polygon(std::uint32_t vertex) {
    const int count = static_cast<int>(corner_count());
    const int turns = turns_[vertex] / count;
    if (turns == 0 || count < 3) return;
    loop_.clear();
    for (std::uint32_t i = 0; i < corner_count(); ++i) {
      loop_.push_back(name(vertex, i));
    }
    if (turns < 0) std::reverse(loop_.begin(), loop_.end());
    for (int i = 0; i < std::abs(turns); ++i) {
      sum_.add_facet(loop_, turns > 0 ? normal_ : -normal_);
    }
  }

  const std::vector<Vec3>& polygon_;
  const Convex& body_;
  const Vec3 normal_;
  Vec3 x_axis_;
  Vec3 y_axis_;
  std::vector<Vec2> plan_;
  std::vector<Vec2> side_normals_;
  std::vector<Vec2> aims_;               // of each facet
  std::vector<std::uint32_t> farthest_;  // corner, of each facet
  std::vector<int> turns_;               // corners passed around each vertex
  std::vector<std::uint32_t> names_;     // of vertex + corner in the sum
  std::vector<std::uint32_t> loop_;
  Convex sum_;
};

// Sine of the angle between planes below which they are parallel.
constexpr double kParallelSine = 1e-12;

bool are_parallel(const Convex& a, const Convex& b) {
  return a.is_flat && b.is_flat &&
         glm::length(glm::cross(a.normals[0], b.normals[0])) < kParallelSine;
}

Convex add_parallel(const Convex& a, const Convex& b) {
  const Vec3 normal = a.normals[0];
  const Vec3 x_axis = glm::normalize(a.vertices[1] - a.vertices[0]);
  const Vec3 y_axis = glm::cross(normal, x_axis);
  const auto lay_out = [&](const Convex& flat) {
    plane::Contour plan;
    for (const Vec3& v : flat.vertices) {
      plan.push_back({glm::dot(v, x_axis), glm::dot(v, y_axis)});
    }
    if (glm::dot(flat.normals[0], normal) < 0) {
      std::reverse(plan.begin(), plan.end());
    }
    return plan;
  };
  const double height =
      glm::dot(a.vertices[0], normal) + glm::dot(b.vertices[0], normal);
  std::vector<Vec3> polygon;
  for (const Vec2 p : plane::add_convex(lay_out(a), lay_out(b))) {
    polygon.push_back(p.x * x_axis + p.y * y_axis + height * normal);
  }
  return make_flat(std::move(polygon), normal);
}

}  // namespace

Convex add_flat(const Convex& flat, const Convex& body) {
  if (are_parallel(flat, body)) return add_parallel(flat, body);
  return FlatSum(flat, body).make();
}

}  // namespace lamina::csg
