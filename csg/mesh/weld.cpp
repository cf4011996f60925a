#include "csg/mesh/weld.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "base/union_find.h"
#include "csg/mesh/box_tree.h"
#include "csg/mesh/drop_triangles.h"
#include "csg/mesh/edge_table.h"

namespace lamina::csg {
namespace {

// Edges that are looked at as partners of one, at most.
constexpr std::size_t kMostPartners = 64;

// Each takes a step that the one before made possible; three are usual.
constexpr int kMostRounds = 16;

struct OpenEdge {
  std::array<std::uint32_t, 2> ends;
  std::uint32_t face = 0;  // the first of those that have it
};

std::vector<OpenEdge> find_open_edges(const Mesh& mesh) {
  std::vector<OpenEdge> open;
  EdgeTable::of(mesh).for_each_edge(
      [&](std::uint32_t low, std::span<const Side> sides) {
        if (sides.size() % 2 == 0) return;
        open.push_back({{low, sides[0].high}, sides[0].face()});
      });
  return open;
}

Box3 box_around(Vec3 point, double reach) {
  return {point - reach, point + reach};
}

// --- Edges that run along each other ----------------------------------------

// Two edges, and how far an end of the one is from that of the other.
struct Pair {
  double distance = 0;
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  bool is_turned = false;  // they run against each other, low to high
};

class Pairing {
 public:
  Pairing(Mesh& mesh, double tolerance)
      : mesh_(mesh),
        tolerance_(tolerance),
        edges_(find_open_edges(mesh)),
        vertices_(mesh.vertices.size()),
        is_joined_(edges_.size()) {}

  // The greatest distance over which edges were joined; none where none were.
  std::optional<double> run() {
    std::optional<double> distance;
    for (const Pair& pair : find_pairs()) {
      if (is_joined_[pair.first] || is_joined_[pair.second] || !join(pair)) {
        continue;
      }
      is_joined_[pair.first] = is_joined_[pair.second] = true;
      distance = pair.distance;
    }
    for (auto& triangle : mesh_.triangles) {
      for (std::uint32_t& corner : triangle) corner = vertices_.find(corner);
    }
    return distance;
  }

 private:
  Vec3 end(const OpenEdge& edge, std::size_t i) const {
    return mesh_.vertices[edge.ends[i]];
  }
  double length(const OpenEdge& edge) const {
    return glm::distance(end(edge, 0), end(edge, 1));
  }

  // The nearest first.
  std::vector<Pair> find_pairs() const {
    std::vector<Box3> middles;
    for (const OpenEdge& edge : edges_) {
      middles.push_back(box_around((end(edge, 0) + end(edge, 1)) / 2.0, 0));
    }
    const BoxTree tree(middles);
    std::vector<Pair> pairs;
    for (std::uint32_t i = 0; i < edges_.size(); ++i) {
      const Box3 around = box_around(middles[i].low, tolerance_);
      std::size_t seen = 0;
      tree.visit(
          [&](const Box3& box) {
            return seen < kMostPartners && do_meet(box, around);
          },
          [&](std::uint32_t k) {
            ++seen;
            if (k <= i) return;
            const Pair pair = measure(i, k);
            // Edges shorter than that show no direction.
            const double shorter =
                std::min(length(edges_[i]), length(edges_[k]));
            if (pair.distance <= std::min(tolerance_, shorter / 2)) {
              pairs.push_back(pair);
            }
          });
    }
    std::ranges::sort(pairs, {}, [](const Pair& pair) {
      return std::tuple(pair.distance, pair.first, pair.second);
    });
    return pairs;
  }

  Pair measure(std::uint32_t i, std::uint32_t k) const {
    const OpenEdge& a = edges_[i];
    const OpenEdge& b = edges_[k];
    const auto apart = [&](std::size_t first, std::size_t second) {
      return std::max(glm::distance(end(a, 0), end(b, first)),
                      glm::distance(end(a, 1), end(b, second)));
    };
    const double along = apart(0, 1);
    const double against = apart(1, 0);
    return {std::min(along, against), i, k, against < along};
  }

  // False where the two ends of an edge would become one.
  bool join(const Pair& pair) {
    const auto ends_of = [this](std::uint32_t edge) {
      return std::array{vertices_.find(edges_[edge].ends[0]),
                        vertices_.find(edges_[edge].ends[1])};
    };
    const auto a = ends_of(pair.first);
    auto b = ends_of(pair.second);
    if (pair.is_turned) std::swap(b[0], b[1]);
    if (a[0] == a[1] || b[0] == b[1] || a[0] == b[1] || a[1] == b[0]) {
      return false;
    }
    for (std::size_t i = 0; i < 2; ++i) vertices_.unite(a[i], b[i]);
    return true;
  }

  Mesh& mesh_;
  const double tolerance_;
  const std::vector<OpenEdge> edges_;
  UnionFind vertices_;  // that have become one
  std::vector<bool> is_joined_;
};

// --- Corners along an edge --------------------------------------------------

// A vertex to be put into an edge.
struct Corner {
  std::uint32_t face = 0;
  std::uint32_t edge = 0;
  double share = 0;  // of the way from the edge's lower end
  std::uint32_t vertex = 0;
};

class Splitting {
 public:
  Splitting(Mesh& mesh, double tolerance)
      : mesh_(mesh), tolerance_(tolerance), edges_(find_open_edges(mesh)) {
    for (const OpenEdge& edge : edges_) {
      sides_.push_back({edge.ends[0], edge.ends[1]});
      sides_.push_back({edge.ends[1], edge.ends[0]});
    }
    std::ranges::sort(sides_);
  }

  // How far the farthest of the corners is from its edge; none where there are
  // none.
  std::optional<double> run() {
    std::vector<Corner> corners = find_corners();
    std::ranges::sort(corners, {}, [](const Corner& corner) {
      return std::tuple(corner.face, corner.edge, corner.share, corner.vertex);
    });
    for (std::size_t begin = 0; begin < corners.size();) {
      std::size_t end = begin;
      while (end < corners.size() && corners[end].face == corners[begin].face &&
             corners[end].edge == corners[begin].edge) {
        ++end;
      }
      split(std::span(corners).subspan(begin, end - begin));
      // Further edges of the triangle must wait until it is known what has
      // them now.
      while (end < corners.size() && corners[end].face == corners[begin].face) {
        ++end;
      }
      begin = end;
    }
    return distance_;
  }

 private:
  // Where a point lies along an edge, and how far from it.
  struct Projection {
    double share = 0;
    double distance = std::numeric_limits<double>::infinity();
  };
  Projection project(Vec3 point, const OpenEdge& edge) const {
    const Vec3 from = mesh_.vertices[edge.ends[0]];
    const Vec3 along = mesh_.vertices[edge.ends[1]] - from;
    const double square = glm::dot(along, along);
    if (!(square > 0)) return {};
    const double share =
        std::clamp(glm::dot(point - from, along) / square, 0.0, 1.0);
    return {share, glm::distance(point, from + share * along)};
  }

  std::vector<Corner> find_corners() {
    std::vector<Box3> boxes;
    for (const OpenEdge& edge : edges_) {
      Box3 box = box_around(mesh_.vertices[edge.ends[0]], tolerance_);
      box.add(box_around(mesh_.vertices[edge.ends[1]], tolerance_));
      boxes.push_back(box);
    }
    const BoxTree tree(boxes);
    std::vector<Corner> corners;
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      const std::uint32_t vertex = sides_[i].first;
      if (i > 0 && sides_[i - 1].first == vertex) continue;
      const Vec3 point = mesh_.vertices[vertex];
      std::size_t seen = 0;
      tree.visit(
          [&](const Box3& box) {
            return seen < kMostPartners && do_meet(box, Box3{point, point});
          },
          [&](std::uint32_t edge) {
            ++seen;
            add_corner(vertex, edge, corners);
          });
    }
    return corners;
  }

  void add_corner(std::uint32_t vertex, std::uint32_t number,
                  std::vector<Corner>& corners) {
    const OpenEdge& edge = edges_[number];
    const auto& triangle = mesh_.triangles[edge.face];
    if (std::ranges::find(triangle, vertex) != triangle.end()) return;
    const Vec3 point = mesh_.vertices[vertex];
    const Projection place = project(point, edge);
    if (place.distance > tolerance_) return;
    for (const std::uint32_t end : edge.ends) {
      if (glm::distance(point, mesh_.vertices[end]) <= tolerance_) return;
    }
    if (!has_side_along(vertex, edge)) return;
    distance_ = std::max(distance_.value_or(0), place.distance);
    corners.push_back({edge.face, number, place.share, vertex});
  }

  // Whether an open edge at the vertex runs along the other edge.
  bool has_side_along(std::uint32_t vertex, const OpenEdge& edge) const {
    const auto begin = std::ranges::lower_bound(
        sides_, vertex, {}, &std::pair<std::uint32_t, std::uint32_t>::first);
    for (auto side = begin; side != sides_.end() && side->first == vertex;
         ++side) {
      if (project(mesh_.vertices[side->second], edge).distance <= tolerance_) {
        return true;
      }
    }
    return false;
  }

  // Puts the vertices, in their order, into their edge of the triangle.
  void split(std::span<const Corner> corners) {
    const OpenEdge& edge = edges_[corners.front().edge];
    std::array<std::uint32_t, 3> triangle = mesh_.triangles[edge.face];
    while (triangle[2] == edge.ends[0] || triangle[2] == edge.ends[1]) {
      std::rotate(triangle.begin(), triangle.begin() + 1, triangle.end());
    }
    std::vector<std::uint32_t> path{edge.ends[0]};
    for (const Corner& corner : corners) path.push_back(corner.vertex);
    path.push_back(edge.ends[1]);
    if (triangle[0] != edge.ends[0]) std::ranges::reverse(path);
    mesh_.triangles[edge.face] = {path[0], path[1], triangle[2]};
    for (std::size_t i = 1; i + 1 < path.size(); ++i) {
      mesh_.triangles.push_back({path[i], path[i + 1], triangle[2]});
    }
  }

  Mesh& mesh_;
  const double tolerance_;
  const std::vector<OpenEdge> edges_;
  // Of each open edge both ends with the other one, sorted.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sides_;
  std::optional<double> distance_;
};

}  // namespace

double weld_tolerance(const Mesh& mesh) {
  constexpr double kUnseen = 0.004;  // [mm]
  constexpr double kShareOfExtent = 2e-4;
  constexpr double kShareOfCoordinate = 2e-6;
  Box3 box;
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) box.add(mesh.vertices[corner]);
  }
  if (box.is_empty()) return 0;
  const Vec3 far = glm::max(glm::abs(box.low), glm::abs(box.high));
  const double greatest = std::max({far.x, far.y, far.z});
  return std::min(kShareOfExtent * glm::length(box.size()),
                  std::max(kUnseen, kShareOfCoordinate * greatest));
}

Weld weld(Mesh& mesh, double tolerance) {
  Weld weld;
  const std::size_t open_before = find_open_edges(mesh).size();
  for (int round = 0; round < kMostRounds; ++round) {
    // An edge of a triangle that is there twice looks closed.
    weld.repeated_triangles += drop_repeated(mesh);
    const std::optional<double> joined = Pairing(mesh, tolerance).run();
    weld.dropped_triangles += drop_degenerate(mesh);
    const std::optional<double> split = Splitting(mesh, tolerance).run();
    if (!joined && !split) break;
    weld.distance =
        std::max({weld.distance, joined.value_or(0), split.value_or(0)});
  }
  const std::size_t open_after = find_open_edges(mesh).size();
  weld.joined_edges = open_before - std::min(open_before, open_after);
  return weld;
}

}  // namespace lamina::csg
