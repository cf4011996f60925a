#include "csg/mesh/manifold_cut.h"

#include <span>
#include <utility>

#include "base/union_find.h"
#include "csg/mesh/edge_table.h"

namespace lamina::csg {
namespace {

bool is_plain(std::span<const Side> sides) {
  return sides.size() == 2 && sides[0].is_rising() != sides[1].is_rising();
}

// A corner is three times its triangle plus its place there.
std::uint32_t corner_at(const Mesh& mesh, std::uint32_t triangle,
                        std::uint32_t vertex) {
  const auto& t = mesh.triangles[triangle];
  return 3 * triangle + (t[0] == vertex ? 0U : t[1] == vertex ? 1U : 2U);
}

// Joins the corners of each fan.
UnionFind join_fans(const Mesh& mesh, const EdgeTable& edges) {
  UnionFind fans(3 * mesh.triangles.size());
  edges.for_each_edge([&](std::uint32_t low, std::span<const Side> sides) {
    if (!is_plain(sides)) return;
    for (const std::uint32_t end : {low, sides[0].high}) {
      fans.unite(corner_at(mesh, sides[0].face(), end),
                 corner_at(mesh, sides[1].face(), end));
    }
  });
  return fans;
}

// Gives each fan a vertex.
void name_fans(const Mesh& mesh, UnionFind& fans, ManifoldCut& cut) {
  std::vector<std::uint32_t> last_copies(mesh.vertices.size(),
                                         ManifoldCut::kNone);
  cut.mesh.triangles = mesh.triangles;
  cut.mesh.vertices.reserve(mesh.vertices.size());
  // The root of a fan is its first corner, so it has its name by then.
  for (std::uint32_t corner = 0; corner < 3 * mesh.triangles.size(); ++corner) {
    const std::uint32_t root = fans.find(corner);
    std::uint32_t& name = cut.mesh.triangles[corner / 3][corner % 3];
    if (root != corner) {
      name = cut.mesh.triangles[root / 3][root % 3];
      continue;
    }
    const std::uint32_t origin = name;
    name = static_cast<std::uint32_t>(cut.origins.size());
    cut.mesh.vertices.push_back(mesh.vertices[origin]);
    cut.origins.push_back(origin);
    const std::uint32_t last = std::exchange(last_copies[origin], name);
    cut.is_rim.push_back(last != ManifoldCut::kNone);
    if (last == ManifoldCut::kNone) continue;
    cut.tangled_vertices += cut.is_rim[last] ? 0 : 1;
    cut.is_rim[last] = true;
  }
}

}  // namespace

ManifoldCut cut_to_manifold(const Mesh& mesh) {
  ManifoldCut cut;
  const EdgeTable edges = EdgeTable::of(mesh);
  UnionFind fans = join_fans(mesh, edges);
  name_fans(mesh, fans, cut);
  const std::size_t count = cut.mesh.vertices.size();
  cut.rim_next.assign(count, ManifoldCut::kNone);
  cut.is_open.assign(count, false);
  edges.for_each_edge([&](std::uint32_t low, std::span<const Side> sides) {
    if (is_plain(sides)) return;
    ++(sides.size() == 1 ? cut.open_edges : cut.tangled_edges);
    const auto rising =
        std::count_if(sides.begin(), sides.end(),
                      [](const Side& side) { return side.is_rising(); });
    if (2 * static_cast<std::size_t>(rising) != sides.size()) {
      cut.is_closed = false;
    }
    for (const Side& side : sides) {
      const auto copy_of = [&](std::uint32_t end) {
        const std::uint32_t corner = corner_at(mesh, side.face(), end);
        return cut.mesh.triangles[corner / 3][corner % 3];
      };
      std::uint32_t from = copy_of(low);
      std::uint32_t to = copy_of(side.high);
      if (!side.is_rising()) std::swap(from, to);
      cut.is_rim[from] = cut.is_rim[to] = true;
      cut.rim_next[from] = to;
      cut.is_open[from] = sides.size() == 1;
    }
  });
  return cut;
}

Topology find_topology(const ManifoldCut& cut) {
  const auto vertex_count =
      static_cast<std::uint32_t>(cut.mesh.vertices.size());
  UnionFind components(vertex_count);
  for (const auto& t : cut.mesh.triangles) {
    components.unite(t[0], t[1]);
    components.unite(t[1], t[2]);
  }
  Topology topology;
  std::size_t rims = 0;  // loops, open or tangled
  std::size_t rim_sides = 0;
  std::vector<bool> is_walked(vertex_count);
  for (std::uint32_t i = 0; i < vertex_count; ++i) {
    topology.components += components.find(i) == i ? 1 : 0;
    if (is_walked[i] || cut.rim_next[i] == ManifoldCut::kNone) continue;
    ++rims;
    bool is_open = false;
    for (std::uint32_t at = i; !is_walked[at]; at = cut.rim_next[at]) {
      is_walked[at] = true;
      ++rim_sides;
      is_open = is_open || cut.is_open[at];
    }
    topology.boundary_loops += is_open ? 1 : 0;
  }
  // Euler: V - E + F = 2 components - 2 genus - rims.
  const std::size_t faces = cut.mesh.triangles.size();
  const std::size_t edges = (3 * faces + rim_sides) / 2;
  topology.genus =
      (2 * topology.components - rims + edges - vertex_count - faces) / 2;
  return topology;
}

}  // namespace lamina::csg
