// Repairs of meshes, on a table of edges.
//
// Here a mesh is only a list of triangles and a sorted table of their edges,
// which anything fits, and "closed" is a sum: as many a→b as b→a. Holes are
// what is missing from that sum; as the boundary of anything has no boundary,
// the missing edges always fall into loops, and every loop can be capped.
//
// Nearly every file is closed once its equal vertices are one. A sum in which
// matched edges cancel shows this without the table, and nothing is repaired.

#include "csg/lower/detail/repair.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "csg/boundary/leaf_mesh.h"
#include "csg/lower/detail/face.h"
#include "csg/mesh/edge_table.h"
#include "csg/mesh/vertex_table.h"

namespace lamina::csg {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

// Vertices closer than this [mm] are one where a mesh is open otherwise: the
// grid on which OpenSCAD puts its vertices. Points of neighbouring faces that
// were computed apart differ by rounding, 1e-15 or so; nobody prints 1e-6.
constexpr double kMergeDistance = 0.00000095367431640625;

void rename_corners(Mesh& mesh, const std::vector<std::uint32_t>& new_names) {
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& corner : t) corner = new_names[corner];
  }
}

// Lets triangles name the first of vertices within kMergeDistance, found in
// the cells of that size around each.
void merge_near_vertices(Mesh& mesh) {
  VertexTable cells;
  std::vector<std::uint32_t> first_in_cell;  // by name of the cell
  std::vector<std::uint32_t> merged;
  merged.reserve(mesh.vertices.size());
  const auto find_near = [&](const Vec3& vertex, const Vec3& cell) {
    for (int i = 0; i < 27; ++i) {
      const Vec3 shift(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      const auto found = cells.find(cell + shift);
      if (!found) continue;
      const std::uint32_t first = first_in_cell[*found];
      if (glm::distance(mesh.vertices[first], vertex) <= kMergeDistance) {
        return first;
      }
    }
    return static_cast<std::uint32_t>(merged.size());
  };
  for (const Vec3& vertex : mesh.vertices) {
    const Vec3 cell = glm::floor(vertex / kMergeDistance);
    const std::uint32_t name = find_near(vertex, cell);
    const bool is_first = name == merged.size();
    if (is_first && cells.name(cell) == first_in_cell.size()) {
      first_in_cell.push_back(name);
    }
    merged.push_back(name);
  }
  rename_corners(mesh, merged);
}

// A number drawn for the vertex, the same each time.
std::uint64_t draw(std::uint32_t vertex) {
  std::uint64_t x = (vertex + 1) * 0xbf58476d1ce4e5b9u;
  x = (x ^ x >> 32) * 0x94d049bb133111ebu;
  return x ^ x >> 29;
}

// Whether every directed edge is matched by as many of the opposite direction.
// To each edge from a to b belongs the cube of the difference of numbers drawn
// for a and b, which changes its sign with the direction: over a closed mesh
// these sum up to 0. Over any other the sum is a polynomial in the numbers with
// a coefficient of 3 or more at a²b of each edge that is not matched, and so it
// is 0 once in some 2^60 meshes.
bool is_closed(const Mesh& mesh) {
  std::uint64_t sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const std::uint64_t a = draw(t[0]);
    const std::uint64_t b = draw(t[1]);
    const std::uint64_t c = draw(t[2]);
    const auto cube = [](std::uint64_t x) { return x * x * x; };
    sum += cube(b - a) + cube(c - b) + cube(a - c);
  }
  return sum == 0;
}

std::size_t drop_degenerate(Mesh& mesh) {
  return std::erase_if(mesh.triangles, [](const Triangle& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  });
}

// Keeps the first of triangles with the same corners in the same order.
std::size_t drop_repeated(Mesh& mesh) {
  std::vector<Triangle> turned = mesh.triangles;
  for (Triangle& t : turned) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  }
  std::vector<std::uint32_t> order(turned.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tie(turned[a], a) < std::tie(turned[b], b);
  });
  std::vector<bool> is_repeated(turned.size());
  for (std::size_t i = 1; i < order.size(); ++i) {
    is_repeated[order[i]] = turned[order[i]] == turned[order[i - 1]];
  }
  return std::erase_if(mesh.triangles, [&, i = 0u](const Triangle&) mutable {
    return is_repeated[i++];
  });
}

// Triangles that share a plain edge, and whether they run against each other.
struct Neighbour {
  std::uint32_t triangle = 0;
  bool is_opposed = false;
};

// The neighbours of one triangle, at most one at each side.
class Neighbours {
 public:
  void add(Neighbour neighbour) { all_[count_++] = neighbour; }
  const Neighbour* begin() const { return all_.data(); }
  const Neighbour* end() const { return all_.data() + count_; }

 private:
  std::array<Neighbour, 3> all_{};
  std::uint32_t count_ = 0;
};

std::vector<Neighbours> find_neighbours(const Mesh& mesh) {
  std::vector<Neighbours> neighbours(mesh.triangles.size());
  EdgeTable::of(mesh).for_each_edge(
      [&](std::uint32_t, std::span<const Side> sides) {
        if (sides.size() != 2) return;
        const std::uint32_t a = sides[0].face();
        const std::uint32_t b = sides[1].face();
        const bool is_opposed = sides[0].is_rising() == sides[1].is_rising();
        neighbours[a].add({b, is_opposed});
        neighbours[b].add({a, is_opposed});
      });
  return neighbours;
}

// Turns the minority of each component.
std::size_t orient(Mesh& mesh) {
  const std::vector<Neighbours> neighbours = find_neighbours(mesh);
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
  OpenEdges open;
  EdgeTable::of(mesh).for_each_edge(
      [&](std::uint32_t low, std::span<const Side> sides) {
        int rising = 0;
        for (const Side& side : sides) rising += side.is_rising() ? 1 : -1;
        const std::uint32_t high = sides[0].high;
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
    // Give back the edges that led to the loop.
    for (auto v = path.begin(); v != seen; ++v) open[*v].push_back(*(v + 1));
    return {seen, path.end()};
  }
}

ClosedHole cap(Mesh& mesh, const std::vector<std::uint32_t>& loop) {
  add_face(mesh, loop);
  ClosedHole hole{loop.size(), {}};
  for (const std::uint32_t i : loop) hole.box.add(mesh.vertices[i]);
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

// What is needed where a mesh is not closed.
void repair_open(Mesh& mesh, Repairs& repairs) {
  if (EdgeTable::of(mesh).is_open()) {
    merge_near_vertices(mesh);
    repairs.dropped_triangles += drop_degenerate(mesh);
  }
  repairs.turned_triangles = orient(mesh);
  repairs.repeated_triangles = drop_repeated(mesh);
  repairs.closed_holes = close_holes(mesh);
}

// --- Report -----------------------------------------------------------------

// More holes than this are counted, not listed.
constexpr std::size_t kMostListedHoles = 8;

std::string describe(const ClosedHole& hole) {
  const Vec3 center = (hole.box.low + hole.box.high) / 2.0;
  const Vec3 size = hole.box.high - hole.box.low;
  return fmt::format(
      "closed a hole of {} edges around [{:.6g}, {:.6g}, {:.6g}], "
      "{:.6g} x {:.6g} x {:.6g} mm",
      hole.edge_count, center.x, center.y, center.z, size.x, size.y, size.z);
}

void report(const Repairs& repairs, std::size_t triangle_count,
            SourceRange range, Diagnostics& diagnostics) {
  if (repairs.turned_triangles > 0) {
    diagnostics.warning(
        range, fmt::format("The given mesh has faces of both orientations: "
                           "turned {} of {} triangles",
                           repairs.turned_triangles, triangle_count));
  }
  if (repairs.repeated_triangles > 0) {
    diagnostics.warning(
        range, fmt::format("The given mesh has faces more than once: dropped "
                           "{} of {} triangles",
                           repairs.repeated_triangles, triangle_count));
  }
  const std::vector<ClosedHole>& holes = repairs.closed_holes;
  if (holes.empty()) return;
  std::vector<Note> notes;
  for (std::size_t i = 0; i < std::min(holes.size(), kMostListedHoles); ++i) {
    notes.push_back({range, describe(holes[i])});
  }
  if (holes.size() > kMostListedHoles) {
    notes.push_back({range, fmt::format("and {} more holes",
                                        holes.size() - kMostListedHoles)});
  }
  diagnostics.warning(range, "The given mesh is not closed!", std::move(notes));
}

}  // namespace

void merge_equal_vertices(Mesh& mesh) {
  VertexTable table(mesh.vertices.size());
  std::vector<std::uint32_t> names(mesh.vertices.size());
  table.name(mesh.vertices, names);
  if (table.size() == names.size()) return;
  mesh.vertices = table.take_points();
  rename_corners(mesh, names);
}

Repairs repair(Mesh& mesh, Vertices vertices) {
  Repairs repairs;
  if (vertices != Vertices::kJoined) merge_equal_vertices(mesh);
  repairs.dropped_triangles = drop_degenerate(mesh);
  const bool was_closed = is_closed(mesh);
  if (!was_closed) repair_open(mesh, repairs);
  const bool is_joined = vertices == Vertices::kJoined && was_closed &&
                         repairs.dropped_triangles == 0;
  if (!is_joined) keep_named_points(mesh.vertices, mesh.triangles);
  if (signed_volume(mesh) < 0) {
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  }
  return repairs;
}

void repair_and_report(Mesh& mesh, SourceRange range, Diagnostics& diagnostics,
                       Vertices vertices) {
  const std::size_t triangle_count = mesh.triangles.size();
  report(repair(mesh, vertices), triangle_count, range, diagnostics);
}

}  // namespace lamina::csg
