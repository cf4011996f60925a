#pragma once
// Makes any triangle soup a closed, consistently oriented mesh.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/diagnostic.h"
#include "csg/scene.h"

namespace lamina::csg {

// A hole that was closed.
struct ClosedHole {
  std::size_t edge_count = 0;
  Box3 box;
};

// What was wrong with a mesh; nothing with a sound one.
struct Repairs {
  std::size_t dropped_triangles = 0;   // two corners were the same
  std::size_t joined_edges = 0;        // sides of cracks (csg/mesh/weld.h)
  double join_distance = 0;            // the greatest between two sides [mm]
  std::size_t turned_triangles = 0;    // ran against their neighbours
  std::size_t repeated_triangles = 0;  // dropped, as they were there twice
  std::vector<ClosedHole> closed_holes;

  // Whether any may have changed what the mesh encloses.
  bool were_needed() const {
    return turned_triangles + repeated_triangles + joined_edges +
               closed_holes.size() >
           0;
  }
};

// What is known of a mesh's vertices. kJoined: no two are equal, and each is a
// corner of a triangle.
enum class Vertices : std::uint8_t { kAnyhow, kJoined };

// Makes one vertex of equal ones.
void merge_equal_vertices(Mesh& mesh);

// Merges equal vertices, joins the sides of cracks (csg/mesh/weld.h), turns
// triangles to agree with their neighbours, and closes what is still open.
// Afterwards every directed edge is matched by as many of the opposite
// direction, whatever came in. A mesh of which this holds before keeps all its
// triangles, as winding numbers have no trouble with edges of more than two.
// Otherwise each component keeps the direction of most of its triangles. A mesh
// whose volume comes out negative is turned as a whole.
Repairs repair(Mesh& mesh, Vertices vertices = Vertices::kAnyhow);

// Repairs the mesh, and warns of what was wrong: one warning for each kind of
// defect, with what was done as notes, and one where the layers of what was
// repaired do not have the volume that its faces enclose.
void repair_and_report(Mesh& mesh, SourceRange range, Diagnostics& diagnostics,
                       Vertices vertices = Vertices::kAnyhow);

}  // namespace lamina::csg
