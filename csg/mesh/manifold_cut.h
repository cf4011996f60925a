#pragma once
// A mesh cut open wherever it is not manifold.
//
// Edges of four triangles and cones that meet in a point are nothing for a
// half-edge structure, nor for Euler's formula. Both take a mesh whose
// triangles hang together only over plain edges, those with two triangles that
// run against each other; each fan of triangles that they leave at a vertex
// gets a vertex of its own. Sewn together again, vertex to origin, it is the
// mesh as it was.

#include <cstdint>
#include <vector>

#include "csg/scene.h"

namespace lamina::csg {

struct ManifoldCut {
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  // The triangles in the order of the mesh; a manifold with boundary.
  Mesh mesh;
  std::vector<std::uint32_t> origins;  // of each vertex, in the mesh as it was
  // Vertices at an edge that is not plain, or cut from others of one origin.
  std::vector<bool> is_rim;
  // The vertex to which the only side of the boundary leads that leaves a
  // vertex; kNone inside. And whether its edge had one triangle all along.
  std::vector<std::uint32_t> rim_next;
  std::vector<bool> is_open;
  bool is_closed = true;       // of every edge as many sides rise as fall
  std::size_t open_edges = 0;  // of one triangle
  // Edges of more than two, or of two that do not run against each other.
  std::size_t tangled_edges = 0;
  std::size_t tangled_vertices = 0;  // of several fans, in the mesh as it was
};

// No triangle may name a vertex twice.
ManifoldCut cut_to_manifold(const Mesh& mesh);

// What a surface is like, as a whole.
struct Topology {
  std::size_t components = 0;
  std::size_t genus = 0;           // handles of all components together
  std::size_t boundary_loops = 0;  // with at least one open edge
};

Topology find_topology(const ManifoldCut& cut);

}  // namespace lamina::csg
