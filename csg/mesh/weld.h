#pragma once
// Cracks of a mesh: open edges that run along each other, as programs leave
// them that compute the corners of adjoining faces apart, or round them.
//
// An edge is open where an odd number of triangles has it. Two open edges whose
// ends are near become one, the nearest first and each once: so the two sides
// of a crack meet, and a wall that is thinner than the tolerance does not close
// as long as the edges of its sides have nearer partners. Where a corner of one
// side lies along an edge of the other, the edge is split there.

#include <cstddef>

#include "csg/scene.h"

namespace lamina::csg {

struct Weld {
  std::size_t joined_edges = 0;  // that were open
  double distance = 0;           // the greatest over which any were joined [mm]
  std::size_t dropped_triangles = 0;   // two corners became one
  std::size_t repeated_triangles = 0;  // dropped, as they were there twice
};

// How far the sides of a crack may be apart [mm]: 0.004 mm, less than any
// printer shows, but no more than 1/5,000 of the mesh's extent, as one in
// metres has its details in thousandths. Far from the origin it is 2e-6 of the
// greatest coordinate, as files are written with six digits.
double weld_tolerance(const Mesh& mesh);

// Joins what is open within the tolerance.
//
// mesh  no triangle names a vertex twice
Weld weld(Mesh& mesh, double tolerance);

}  // namespace lamina::csg
