#include "csg/minkowski/convex_pairs.h"

#include <algorithm>
#include <cstdint>

#include <glm/geometric.hpp>

namespace lamina::csg {
namespace {

// Directions that differ by less than rounding count as meeting [mm, along
// edges]: too many pairs do no harm.
constexpr double kSlack = 1e-9;

// The edges and the facets' normals around each vertex.
class Stars {
 public:
  explicit Stars(const Convex& body)
      : body_(body),
        neighbours_(body.vertices.size()),
        normals_(body.vertices.size()) {
    for (const Convex::Edge& edge : body.edges) {
      neighbours_[edge.from].push_back(edge.to);
      neighbours_[edge.to].push_back(edge.from);
      normals_[edge.from].push_back(body.normals[edge.left]);
      normals_[edge.to].push_back(body.normals[edge.right]);
    }
  }

  const std::vector<std::uint32_t>& neighbours(std::uint32_t vertex) const {
    return neighbours_[vertex];
  }
  const std::vector<Vec3>& normals(std::uint32_t vertex) const {
    return normals_[vertex];
  }
  const Vec3& position(std::uint32_t vertex) const {
    return body_.vertices[vertex];
  }

  // A vertex that lies farthest along `direction`, climbing from `start`.
  std::uint32_t climb(std::uint32_t start, const Vec3& direction) const {
    for (std::uint32_t best = start;; start = best) {
      for (const std::uint32_t next : neighbours_[start]) {
        if (glm::dot(position(next) - position(best), direction) > 0) {
          best = next;
        }
      }
      if (best == start) return best;
    }
  }

  // Whether some edge at `vertex` rises along all these directions, so that
  // the vertex is farthest along none of them.
  bool is_passed(std::uint32_t vertex,
                 const std::vector<Vec3>& directions) const {
    const std::vector<std::uint32_t>& all = neighbours_[vertex];
    return std::any_of(all.begin(), all.end(), [&](std::uint32_t next) {
      const Vec3 edge = position(next) - position(vertex);
      return std::all_of(
          directions.begin(), directions.end(),
          [&](const Vec3& n) { return glm::dot(n, edge) > kSlack; });
    });
  }

 private:
  const Convex& body_;
  std::vector<std::vector<std::uint32_t>> neighbours_;
  std::vector<std::vector<Vec3>> normals_;
};

}  // namespace

std::vector<Vec3> extreme_sums(const Convex& a, const Convex& b) {
  const Stars a_stars(a);
  const Stars b_stars(b);
  std::vector<Vec3> sums;
  std::vector<std::uint32_t> waiting;
  std::vector<std::uint32_t> seen_by(b.vertices.size(), ~std::uint32_t{0});
  std::uint32_t farthest = 0;
  for (std::uint32_t p = 0; p < a.vertices.size(); ++p) {
    const std::vector<Vec3>& normals = a_stars.normals(p);
    if (normals.empty()) continue;
    Vec3 direction(0);
    for (const Vec3& normal : normals) direction += normal;
    // The vertices of b whose directions meet those of p are connected.
    farthest = b_stars.climb(farthest, direction);
    waiting.assign(1, farthest);
    seen_by[farthest] = p;
    while (!waiting.empty()) {
      const std::uint32_t q = waiting.back();
      waiting.pop_back();
      if (b_stars.is_passed(q, normals) ||
          a_stars.is_passed(p, b_stars.normals(q))) {
        continue;
      }
      sums.push_back(a.vertices[p] + b.vertices[q]);
      for (const std::uint32_t next : b_stars.neighbours(q)) {
        if (seen_by[next] == p) continue;
        seen_by[next] = p;
        waiting.push_back(next);
      }
    }
  }
  return sums;
}

}  // namespace lamina::csg
