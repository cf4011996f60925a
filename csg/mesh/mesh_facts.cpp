#include "csg/mesh/mesh_facts.h"

#include <vector>

#include <glm/geometric.hpp>

#include "csg/mesh/drop_triangles.h"
#include "csg/mesh/manifold_cut.h"
#include "csg/mesh/vertex_table.h"

namespace lamina::csg {

MeshFacts measure(Mesh mesh) {
  drop_degenerate(mesh);
  keep_named_points(mesh.vertices, mesh.triangles);
  MeshFacts facts;
  facts.vertices = mesh.vertices.size();
  facts.triangles = mesh.triangles.size();
  const ManifoldCut cut = cut_to_manifold(mesh);
  const Topology topology = find_topology(cut);
  facts.components = topology.components;
  facts.genus = topology.genus;
  facts.boundary_loops = topology.boundary_loops;
  facts.open_edges = cut.open_edges;
  facts.tangled_edges = cut.tangled_edges;
  facts.tangled_vertices = cut.tangled_vertices;
  facts.is_closed = cut.is_closed;
  facts.box.add(mesh.vertices);
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]];
    const Vec3 cross =
        glm::cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a);
    facts.area += glm::length(cross) / 2;
    facts.volume += glm::dot(a - facts.box.center(), cross) / 6;
  }
  return facts;
}

}  // namespace lamina::csg
