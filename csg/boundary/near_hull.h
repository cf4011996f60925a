#pragma once
// Solids that are convex but for what their mesher did.
//
// The mesh of a round solid need not be convex, though its vertices lie on the
// solid: between four of them, which lie in no plane, it may have the diagonal
// that lies deeper. Sums of what is convex cost a share of what others do.

#include <optional>

#include "csg/scene.h"

namespace lamina::csg {

// The hull of a closed mesh; none where it is farther from the solid than the
// depth: where a point of the mesh lies deeper below it, or that can't be told
// from the hull's facets at the corners of the point's triangle; or where below
// a point of a facet, straight down, no face of the mesh lies so near and faces
// about the same side.
std::optional<Mesh> near_hull(const Mesh& mesh, double depth);

}  // namespace lamina::csg
