#pragma once
// What a mesh is like before anything is repaired: what `lamina inspect` says
// of a scan.

#include <cstddef>

#include "csg/scene.h"

namespace lamina::csg {

struct MeshFacts {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t components = 0;      // over plain edges (csg/mesh/manifold_cut.h)
  std::size_t genus = 0;           // handles of all components together
  std::size_t boundary_loops = 0;  // around holes
  std::size_t open_edges = 0;      // of one triangle
  // Edges of more than two triangles, or of two that do not run against each
  // other; vertices at which several fans of triangles meet.
  std::size_t tangled_edges = 0;
  std::size_t tangled_vertices = 0;
  bool is_closed = false;  // as much one way as the other along every edge
  Box3 box;
  double area = 0;    // [mm²]
  double volume = 0;  // [mm³]; of an open mesh, as seen from the box's middle
};

// No two vertices may be equal.
MeshFacts measure(Mesh mesh);

}  // namespace lamina::csg
