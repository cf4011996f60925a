#include "csg/minkowski/convex.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>

#include "csg/mesh/edge_table.h"
#include "csg/mesh/vertex_table.h"

namespace lamina::csg {
namespace {

using Edge = Convex::Edge;

// Sine of the angle by which an edge may be reflex and the solid count as
// convex: what rounding does to facets a thousand times longer than wide.
constexpr double kReflexSine = 1e-9;

// Top and base of a prism agree to this part of its size.
constexpr double kPrismPrecision = 1e-13;

bool has_reflex_edge(const Convex& body) {
  return std::any_of(
      body.edges.begin(), body.edges.end(), [&](const Edge& edge) {
        const Vec3 along = body.vertices[edge.to] - body.vertices[edge.from];
        const Vec3 turn =
            glm::cross(body.normals[edge.left], body.normals[edge.right]);
        return glm::dot(turn, along) < -kReflexSine * glm::length(along);
      });
}

// What is thinner than this part of the greatest coordinate is a line that
// rounding has bent, as sums of equal edges leave them: its normal is noise.
constexpr double kNeedlePrecision = 1e-13;

Vec3 middle_of(const Convex& body, std::span<const std::uint32_t> loop) {
  Vec3 sum(0);
  for (const std::uint32_t corner : loop) sum += body.vertices[corner];
  return sum / static_cast<double>(loop.size());
}

// Whether the facet meets the ray from `origin` along `direction`, which
// leaves the body there.
bool is_hit(const Convex& body, std::size_t facet, const Vec3& origin,
            const Vec3& direction) {
  if (glm::dot(body.normals[facet], direction) <= 0) return false;
  const auto loop = body.facet(facet);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3 a = body.vertices[loop[i]] - origin;
    const Vec3 b =
        body.vertices[loop[i + 1 == loop.size() ? 0 : i + 1]] - origin;
    if (glm::dot(glm::cross(a, b), direction) < 0) return false;
  }
  return true;
}

// By Euler's formula. A needle and its reverse beside a solid are a piece of
// their own, without normals that would tell.
bool is_like_sphere(const Convex& body) {
  return body.vertices.size() + body.facet_count() == body.edges.size() + 2;
}

// Whether a surface without reflex edges bounds a convex solid: its facets all
// face away from the middle, which sees each direction once.
bool is_seen_once(const Convex& body) {
  const Vec3 center = middle(body);
  for (std::size_t f = 0; f < body.facet_count(); ++f) {
    const Vec3 corner = body.vertices[body.facet(f).front()];
    const bool is_line = body.normals[f] == Vec3(0);
    if (!is_line && glm::dot(body.normals[f], corner - center) <= 0) {
      return false;
    }
  }
  const auto normal = std::find_if(body.normals.begin(), body.normals.end(),
                                   [](const Vec3& n) { return n != Vec3(0); });
  if (normal == body.normals.end()) return false;
  const auto aim = static_cast<std::size_t>(normal - body.normals.begin());
  const Vec3 direction = middle_of(body, body.facet(aim)) - center;
  int hits = 0;
  for (std::size_t f = 0; f < body.facet_count(); ++f) {
    hits += is_hit(body, f, center, direction) ? 1 : 0;
  }
  return hits == 1;
}

double greatest_length(std::span<const Vec3> vertices) {
  double greatest = 0;
  for (const Vec3& vertex : vertices) {
    greatest = std::max(greatest, glm::length(vertex));
  }
  return greatest;
}

// The shift from the base to the other facet, if it is the same everywhere.
std::optional<Vec3> prism_axis(const Convex& solid,
                               std::span<const std::uint32_t> base) {
  std::vector<bool> is_base(solid.vertices.size(), false);
  for (const std::uint32_t corner : base) is_base[corner] = true;
  const double size = greatest_length(solid.vertices);
  std::optional<Vec3> axis;
  std::size_t sides = 0;
  for (const Edge& edge : solid.edges) {
    if (is_base[edge.from] == is_base[edge.to]) continue;
    const Vec3 rise = solid.vertices[edge.to] - solid.vertices[edge.from];
    const Vec3 shift = is_base[edge.from] ? rise : -rise;
    if (!axis) axis = shift;
    if (glm::distance(*axis, shift) > kPrismPrecision * size) return {};
    ++sides;
  }
  if (sides != base.size()) return {};
  return axis;
}

// Twice the area of a polygon, along its normal.
Vec3 area_of(std::span<const Vec3> vertices,
             std::span<const std::uint32_t> loop) {
  Vec3 sum(0);
  for (std::size_t i = 2; i < loop.size(); ++i) {
    sum += glm::cross(vertices[loop[i - 1]] - vertices[loop[0]],
                      vertices[loop[i]] - vertices[loop[0]]);
  }
  return sum;
}

double longest_side(std::span<const Vec3> vertices,
                    std::span<const std::uint32_t> loop) {
  double longest = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::uint32_t next = loop[i + 1 == loop.size() ? 0 : i + 1];
    longest =
        std::max(longest, glm::distance(vertices[loop[i]], vertices[next]));
  }
  return longest;
}

// Facets of no area have no direction of their own: they take that of their
// neighbours.
void aim_needles(Convex& body) {
  std::vector<Vec3> sums(body.facet_count(), Vec3(0));
  for (const Edge& edge : body.edges) {
    sums[edge.left] += body.normals[edge.right];
    sums[edge.right] += body.normals[edge.left];
  }
  for (std::size_t f = 0; f < sums.size(); ++f) {
    const double size = glm::length(sums[f]);
    if (body.normals[f] == Vec3(0) && size > 0) {
      body.normals[f] = sums[f] / size;
    }
  }
}

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

  // A vertex that lies farthest along `direction`, climbing from `start`. Each
  // step rises in one number for each vertex: signs of differences may lead
  // around in a ring, where rounding decides. Of a corner within a straight
  // edge that lies level no neighbour may be higher: so the climb goes on from
  // all that are as high, up to rounding.
  std::uint32_t climb(std::uint32_t start, const Vec3& direction) const {
    const double slack = kSlack * glm::length(direction);
    double height = glm::dot(position(start), direction);
    std::vector<std::uint32_t> level(1, start);
    for (std::size_t i = 0; i < level.size();) {
      std::uint32_t best = level[0];
      for (const std::uint32_t next : neighbours_[level[i]]) {
        const double other = glm::dot(position(next), direction);
        if (other > height) {
          height = other;
          best = next;
        } else if (other >= height - slack &&
                   std::find(level.begin(), level.end(), next) == level.end()) {
          level.push_back(next);
        }
      }
      ++i;
      if (best == level[0]) continue;
      level.assign(1, best);
      i = 0;
    }
    return level[0];
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

void find_edges(Convex& body) {
  const auto table = EdgeTable::make(body.vertices.size(), [&body](auto visit) {
    for (std::uint32_t f = 0; f < body.facet_count(); ++f) {
      const auto loop = body.facet(f);
      for (std::size_t i = 0; i < loop.size(); ++i) {
        visit(f, loop[i], loop[i + 1 == loop.size() ? 0 : i + 1]);
      }
    }
  });
  body.edges.clear();
  body.is_closed = true;
  std::vector<std::uint32_t> rising;
  std::vector<std::uint32_t> falling;
  table.for_each_edge([&](std::uint32_t low, std::span<const Side> sides) {
    rising.clear();
    falling.clear();
    for (const Side& side : sides) {
      (side.is_rising() ? rising : falling).push_back(side.face());
    }
    if (rising.size() != falling.size()) {
      body.is_closed = false;
      return;
    }
    for (std::size_t i = 0; i < rising.size(); ++i) {
      // cppcheck-suppress containerOutOfBounds ; as many as those that rise
      body.edges.push_back({low, sides[0].high, rising[i], falling[i]});
    }
  });
}

void Convex::add_facet(std::span<const std::uint32_t> loop, Vec3 normal) {
  corners.insert(corners.end(), loop.begin(), loop.end());
  facet_ends.push_back(static_cast<std::uint32_t>(corners.size()));
  normals.push_back(normal);
}

Convex make_flat(std::vector<Vec3> polygon, Vec3 normal) {
  polygon.erase(std::unique(polygon.begin(), polygon.end()), polygon.end());
  while (polygon.size() > 1 && polygon.front() == polygon.back()) {
    polygon.pop_back();
  }
  Convex body;
  body.is_flat = true;
  body.vertices = std::move(polygon);
  const auto count = static_cast<std::uint32_t>(body.vertices.size());
  std::vector<std::uint32_t> loop(count);
  std::iota(loop.begin(), loop.end(), 0U);
  body.add_facet(loop, normal);
  std::reverse(loop.begin(), loop.end());
  body.add_facet(loop, -normal);
  if (count == 1) return body;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t next = i + 1 == count ? 0 : i + 1;
    const Vec3 out = glm::cross(body.vertices[next] - body.vertices[i], normal);
    const std::uint32_t sides[2] = {next, i};
    const auto side = static_cast<std::uint32_t>(body.facet_count());
    body.add_facet(sides, out / glm::length(out));
    body.edges.push_back({i, next, 0, side});
    body.edges.push_back({i, next, side, 1});
  }
  return body;
}

std::vector<Vec3> normals_of(
    std::span<const Vec3> vertices,
    std::span<const std::vector<std::uint32_t>> loops) {
  const double thin = kNeedlePrecision * greatest_length(vertices);
  std::vector<Vec3> normals;
  for (const auto& loop : loops) {
    const Vec3 area = area_of(vertices, loop);
    const double size = glm::length(area);
    const bool is_line = size <= thin * longest_side(vertices, loop);
    normals.push_back(is_line ? Vec3(0) : area / size);
  }
  return normals;
}

Convex make_solid(std::vector<Vec3> vertices,
                  std::span<const std::vector<std::uint32_t>> loops) {
  Convex body;
  body.vertices = std::move(vertices);
  const std::vector<Vec3> normals = normals_of(body.vertices, loops);
  for (std::size_t i = 0; i < loops.size(); ++i) {
    body.add_facet(loops[i], normals[i]);
  }
  std::span facets(&body.corners, 1);
  keep_named_points(body.vertices, facets);
  find_edges(body);
  aim_needles(body);
  return body;
}

bool is_convex(const Convex& body) {
  return body.is_closed && body.facet_count() >= 4 && is_like_sphere(body) &&
         !has_reflex_edge(body) && is_seen_once(body);
}

Convex move(Convex body, const Vec3& shift) {
  for (Vec3& vertex : body.vertices) vertex += shift;
  return body;
}

Vec3 middle(const Convex& body) {
  Vec3 sum(0);
  for (const Vec3& vertex : body.vertices) sum += vertex;
  return sum / static_cast<double>(body.vertices.size());
}

std::optional<Prism> as_prism(const Convex& solid) {
  // The base is one of two facets that have all vertices between them.
  const std::size_t count = solid.vertices.size() / 2;
  if (solid.is_flat || solid.vertices.size() % 2 != 0 ||
      solid.facet_count() != count + 2) {
    return std::nullopt;
  }
  for (std::size_t f = 0; f < solid.facet_count(); ++f) {
    if (solid.facet(f).size() != count) continue;
    if (const auto axis = prism_axis(solid, solid.facet(f))) {
      std::vector<Vec3> polygon;
      for (const std::uint32_t corner : solid.facet(f)) {
        polygon.push_back(solid.vertices[corner]);
      }
      const Vec3 across = glm::cross(*axis, polygon[1] - polygon[0]);
      return Prism{make_flat(std::move(polygon), solid.normals[f]),
                   make_flat({Vec3(0), *axis}, across / glm::length(across))};
    }
  }
  return std::nullopt;
}

void append_triangles(const Convex& body, Mesh& mesh) {
  const auto shift = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), body.vertices.begin(),
                       body.vertices.end());
  for (std::size_t f = 0; f < body.facet_count(); ++f) {
    const auto loop = body.facet(f);
    for (std::size_t i = 2; i < loop.size(); ++i) {
      mesh.triangles.push_back(
          {loop[0] + shift, loop[i - 1] + shift, loop[i] + shift});
    }
  }
}

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
