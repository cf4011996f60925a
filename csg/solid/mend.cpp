// Mending on a table of edges.
//
// A half-edge structure refuses what designs are full of: edges of four
// triangles, cones that meet in a point. Here a mesh is only a list of
// triangles and a sorted list of their edges, which anything fits, and "closed"
// is a sum: as many a→b as b→a. Holes are what is missing from that sum; as
// the boundary of anything has no boundary, the missing edges always fall into
// loops, and every loop can be capped.

#include "csg/solid/detail/mend.h"

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include <glm/geometric.hpp>

#include "csg/solid/detail/face.h"
#include "csg/solid/leaf_mesh.h"

namespace lamina::csg {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

// Vertices closer than this [mm] are one where a mesh is open otherwise: the
// grid on which OpenSCAD puts its vertices. Points of neighbouring faces that
// were computed apart differ by rounding, 1e-15 or so; nobody prints 1e-6.
constexpr double kMergeDistance = 0.00000095367431640625;

struct VertexLess {
  bool operator()(const Vec3& a, const Vec3& b) const {
    if (a.x != b.x) return a.x < b.x;
    if (a.y != b.y) return a.y < b.y;
    return a.z < b.z;
  }
};

void rename_corners(Mesh& mesh, const std::vector<std::uint32_t>& new_names) {
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& corner : t) corner = new_names[corner];
  }
}

// Lets triangles name the first of equal vertices.
void merge_equal_vertices(Mesh& mesh) {
  std::map<Vec3, std::uint32_t, VertexLess> first;
  std::vector<std::uint32_t> merged;
  merged.reserve(mesh.vertices.size());
  for (const Vec3& vertex : mesh.vertices) {
    const auto id = static_cast<std::uint32_t>(merged.size());
    merged.push_back(first.try_emplace(vertex, id).first->second);
  }
  rename_corners(mesh, merged);
}

// Lets triangles name the first of vertices within kMergeDistance, found in
// the cells of that size around each.
void merge_near_vertices(Mesh& mesh) {
  std::map<Vec3, std::uint32_t, VertexLess> first_in_cell;
  std::vector<std::uint32_t> merged;
  merged.reserve(mesh.vertices.size());
  const auto find_near = [&](const Vec3& vertex, const Vec3& cell) {
    for (int i = 0; i < 27; ++i) {
      const Vec3 shift(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      const auto found = first_in_cell.find(cell + shift);
      if (found != first_in_cell.end() &&
          glm::distance(mesh.vertices[found->second], vertex) <=
              kMergeDistance) {
        return found->second;
      }
    }
    return static_cast<std::uint32_t>(merged.size());
  };
  for (const Vec3& vertex : mesh.vertices) {
    const Vec3 cell = glm::floor(vertex / kMergeDistance);
    const std::uint32_t name = find_near(vertex, cell);
    if (name == merged.size()) first_in_cell.try_emplace(cell, name);
    merged.push_back(name);
  }
  rename_corners(mesh, merged);
}

std::size_t drop_degenerate(Mesh& mesh) {
  return std::erase_if(mesh.triangles, [](const Triangle& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  });
}

// Keeps the first of triangles with the same corners in the same order.
std::size_t drop_repeated(Mesh& mesh) {
  std::set<Triangle> seen;
  return std::erase_if(mesh.triangles, [&](Triangle t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return !seen.insert(t).second;
  });
}

// One side of one triangle, the smaller vertex first.
struct Side {
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  std::uint32_t triangle = 0;
  bool is_rising = false;  // the triangle runs from low to high

  bool is_same_edge(const Side& other) const {
    return low == other.low && high == other.high;
  }
};

// Sorted by edge, so that the sides of an edge stand together.
std::vector<Side> collect_sides(const Mesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k];
      const std::uint32_t b = t[(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), i, a < b});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle) <
           std::tie(b.low, b.high, b.triangle);
  });
  return sides;
}

// Calls visit(begin, end) for the sides of each edge.
template <typename Visit>
void for_each_edge(const std::vector<Side>& sides, Visit visit) {
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].is_same_edge(sides[begin])) ++end;
    visit(begin, end);
  }
}

// True where an edge has no partner, however the triangles are turned.
bool is_open(const Mesh& mesh) {
  bool is_any_odd = false;
  for_each_edge(collect_sides(mesh), [&](std::size_t begin, std::size_t end) {
    is_any_odd = is_any_odd || (end - begin) % 2 == 1;
  });
  return is_any_odd;
}

// Triangles that share a plain edge, and whether they run against each other.
struct Neighbour {
  std::uint32_t triangle = 0;
  bool is_opposed = false;
};

std::vector<std::vector<Neighbour>> find_neighbours(
    const Mesh& mesh, const std::vector<Side>& sides) {
  std::vector<std::vector<Neighbour>> neighbours(mesh.triangles.size());
  for_each_edge(sides, [&](std::size_t begin, std::size_t end) {
    if (end - begin != 2) return;
    const Side& a = sides[begin];
    const Side& b = sides[begin + 1];
    const bool is_opposed = a.is_rising == b.is_rising;
    neighbours[a.triangle].push_back({b.triangle, is_opposed});
    neighbours[b.triangle].push_back({a.triangle, is_opposed});
  });
  return neighbours;
}

// Turns the minority of each component.
std::size_t orient(Mesh& mesh) {
  const auto neighbours = find_neighbours(mesh, collect_sides(mesh));
  enum class Turn : std::uint8_t { kUnknown, kKeep, kTurn };
  std::vector<Turn> turns(mesh.triangles.size(), Turn::kUnknown);
  std::size_t turned = 0;
  std::vector<std::uint32_t> component;
  for (std::uint32_t seed = 0; seed < turns.size(); ++seed) {
    if (turns[seed] != Turn::kUnknown) continue;
    component.assign(1, seed);
    turns[seed] = Turn::kKeep;
    std::size_t to_turn = 0;
    for (std::size_t i = 0; i < component.size(); ++i) {
      const bool is_turned = turns[component[i]] == Turn::kTurn;
      to_turn += is_turned ? 1 : 0;
      for (const Neighbour& next : neighbours[component[i]]) {
        if (turns[next.triangle] != Turn::kUnknown) continue;
        turns[next.triangle] =
            is_turned != next.is_opposed ? Turn::kTurn : Turn::kKeep;
        component.push_back(next.triangle);
      }
    }
    const Turn minority =
        2 * to_turn > component.size() ? Turn::kKeep : Turn::kTurn;
    for (const std::uint32_t i : component) {
      if (turns[i] != minority) continue;
      std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
      ++turned;
    }
  }
  return turned;
}

using OpenEdges = std::unordered_map<std::uint32_t, std::vector<std::uint32_t>>;

// The directed edges that are missing: from vertex to vertices.
OpenEdges find_open_edges(const Mesh& mesh) {
  const std::vector<Side> sides = collect_sides(mesh);
  OpenEdges open;
  for_each_edge(sides, [&](std::size_t begin, std::size_t end) {
    int rising = 0;
    for (std::size_t i = begin; i < end; ++i) {
      rising += sides[i].is_rising ? 1 : -1;
    }
    const auto [low, high] = std::pair(sides[begin].low, sides[begin].high);
    for (; rising > 0; --rising) open[high].push_back(low);
    for (; rising < 0; ++rising) open[low].push_back(high);
  });
  return open;
}

// Takes edges out until they close a loop that visits no vertex twice.
std::vector<std::uint32_t> take_loop(OpenEdges& open, std::uint32_t start) {
  std::vector<std::uint32_t> path{start};
  for (;;) {
    std::vector<std::uint32_t>& targets = open[path.back()];
    const std::uint32_t next = targets.back();
    targets.pop_back();
    const auto seen = std::find(path.begin(), path.end(), next);
    if (seen == path.end()) {
      path.push_back(next);
      continue;
    }
    // Give the way to the loop back.
    for (auto v = path.begin(); v != seen; ++v) open[*v].push_back(*(v + 1));
    return {seen, path.end()};
  }
}

ClosedHole cap(Mesh& mesh, const std::vector<std::uint32_t>& loop) {
  for (const Triangle& t : triangulate_face(mesh.vertices, loop)) {
    mesh.triangles.push_back(t);
  }
  ClosedHole hole{loop.size(), {}};
  for (const std::uint32_t i : loop) {
    hole.box.low = glm::min(hole.box.low, mesh.vertices[i]);
    hole.box.high = glm::max(hole.box.high, mesh.vertices[i]);
  }
  return hole;
}

std::vector<ClosedHole> close_holes(Mesh& mesh) {
  OpenEdges open = find_open_edges(mesh);
  std::vector<std::uint32_t> starts;
  for (const auto& [from, targets] : open) starts.push_back(from);
  std::sort(starts.begin(), starts.end());
  std::vector<ClosedHole> holes;
  for (const std::uint32_t start : starts) {
    while (!open[start].empty()) {
      holes.push_back(cap(mesh, take_loop(open, start)));
    }
  }
  return holes;
}

// Leaves out what no triangle names.
void drop_unused_vertices(Mesh& mesh) {
  constexpr std::uint32_t kUnused = ~std::uint32_t{0};
  std::vector<std::uint32_t> renamed(mesh.vertices.size(), kUnused);
  std::vector<Vec3> used;
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& corner : t) {
      if (renamed[corner] == kUnused) {
        renamed[corner] = static_cast<std::uint32_t>(used.size());
        used.push_back(mesh.vertices[corner]);
      }
      corner = renamed[corner];
    }
  }
  mesh.vertices = std::move(used);
}

}  // namespace

Mending mend(Mesh& mesh) {
  Mending mending;
  merge_equal_vertices(mesh);
  mending.dropped_triangles = drop_degenerate(mesh);
  if (is_open(mesh)) {
    merge_near_vertices(mesh);
    mending.dropped_triangles += drop_degenerate(mesh);
  }
  mending.turned_triangles = orient(mesh);
  mending.repeated_triangles = drop_repeated(mesh);
  mending.closed_holes = close_holes(mesh);
  drop_unused_vertices(mesh);
  if (signed_volume(mesh) < 0) {
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  }
  return mending;
}

}  // namespace lamina::csg
