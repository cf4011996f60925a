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
#include <cmath>
#include <string>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "csg/boundary/leaf_mesh.h"
#include "csg/boundary/plane_section.h"
#include "csg/lower/detail/face.h"
#include "csg/mesh/drop_triangles.h"
#include "csg/mesh/edge_table.h"
#include "csg/mesh/fill_hole.h"
#include "csg/mesh/vertex_table.h"
#include "csg/mesh/weld.h"
#include "plane/limits.h"
#include "plane/region/boolean.h"

namespace lamina::csg {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

// Edges that were joined over less [mm] are no crack to speak of: the grid on
// which OpenSCAD puts its vertices. Points of neighbouring faces that were
// computed apart differ by rounding, 1e-15 or so; nobody prints 1e-6.
constexpr double kUnspokenDistance = 0.00000095367431640625;

void rename_corners(Mesh& mesh, const std::vector<std::uint32_t>& new_names) {
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& corner : t) corner = new_names[corner];
  }
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

// Whether the loop lies in a plane, but for rounding.
bool is_flat(const Mesh& mesh, const std::vector<std::uint32_t>& loop) {
  constexpr double kFlatness = 1e-6;  // of its extent
  const Vec3 origin = mesh.vertices[loop[0]];
  Vec3 normal(0);  // by Newell
  double extent = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3 here = mesh.vertices[loop[i]] - origin;
    const Vec3 next = mesh.vertices[loop[(i + 1) % loop.size()]] - origin;
    normal += glm::cross(here, next);
    extent = std::max(extent, glm::length(here));
  }
  const double slack = kFlatness * extent * glm::length(normal);
  return std::ranges::all_of(loop, [&](std::uint32_t vertex) {
    return std::abs(glm::dot(mesh.vertices[vertex] - origin, normal)) <= slack;
  });
}

ClosedHole cap(Mesh& mesh, const std::vector<std::uint32_t>& loop) {
  if (is_flat(mesh, loop)) {
    add_face(mesh, loop);
  } else {
    fill_hole(mesh, loop);
  }
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
    const Weld weld = csg::weld(mesh, weld_tolerance(mesh));
    repairs.joined_edges = weld.joined_edges;
    repairs.join_distance = weld.distance;
    repairs.dropped_triangles += weld.dropped_triangles;
    repairs.repeated_triangles += weld.repeated_triangles;
  }
  repairs.turned_triangles = orient(mesh);
  repairs.repeated_triangles += drop_repeated(mesh);
  repairs.closed_holes = close_holes(mesh);
}

// --- Volumes ----------------------------------------------------------------

// Of what faces enclose, each part as often as they go around it, and of the
// layers, in which it is once [mm³].
struct Volumes {
  double enclosed = 0;
  double layered = 0;

  bool are_alike() const {
    constexpr double kLeastShare = 0.01;
    return std::abs(enclosed - layered) <=
           kLeastShare * std::max(std::abs(enclosed), layered);
  }
};

// Sections are not made so far out; the design may bring the mesh nearer.
bool is_too_far(const Mesh& mesh) {
  return std::ranges::any_of(mesh.vertices, [](const Vec3& vertex) {
    return plane::is_too_far(vertex.x) || plane::is_too_far(vertex.y) ||
           plane::is_too_far(vertex.z);
  });
}

// Estimates both from the same few sections.
Volumes estimate_volumes(const Mesh& mesh) {
  constexpr int kSections = 32;
  Leaf leaf;
  leaf.meshes.push_back(mesh);
  leaf.box = bound_leaf(leaf, Affine(1.0));
  const PlacedLeaf placed(leaf, Affine(1.0));
  const double thickness = leaf.box.size().z / kSections;
  Volumes volumes;
  for (int i = 0; i < kSections; ++i) {
    const Vec3 point(0, 0, leaf.box.low.z + (i + 0.5) * thickness);
    const plane::Region section = whole_section(placed, Plane(point, {0, 0, 1}),
                                                WindowSection::Side::kAbove);
    volumes.enclosed += thickness * plane::area(section);
    volumes.layered +=
        thickness * plane::area(plane::from_contours(
                        section.contours, plane::FillRule::kNonZero));
  }
  return volumes;
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
  if (repairs.joined_edges > 0 && repairs.join_distance > kUnspokenDistance) {
    diagnostics.warning(
        range, fmt::format("The given mesh is not welded: joined {} open edges "
                           "within {:.2g} mm",
                           repairs.joined_edges, repairs.join_distance));
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
  const Repairs repairs = repair(mesh, vertices);
  report(repairs, triangle_count, range, diagnostics);
  if (!repairs.were_needed() || is_too_far(mesh)) return;
  const Volumes volumes = estimate_volumes(mesh);
  if (volumes.are_alike()) return;
  diagnostics.warning(
      range,
      fmt::format("The given mesh does not keep its volume: its faces enclose "
                  "{:.4g} mm³, its layers have {:.4g} mm³",
                  volumes.enclosed, volumes.layered),
      {{range,
        "some of its faces are inside out, or a hole was closed by "
        "faces that cross others"}});
}

}  // namespace lamina::csg
