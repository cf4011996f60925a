#pragma once
// Loops from edges that meet in vertices only.
//
// Snap rounding ends with a planar graph: edges may run along each other, but
// they do not cross. There is nothing left for a ray to find. Edges that run to
// and fro between two vertices cancel each other, and the rest is linked around
// each vertex, by exact signs.

#include "plane/contours.h"

namespace lamina::slicer {

// Replaces loops by simple ones around the same region. Where regions touch in
// a vertex each has loops of its own, and no loop comes to a vertex twice.
//
// contours  wind around every place once or not at all; edges meet in vertices
//           of both only
void link_planar_loops(plane::Contours& contours);

}  // namespace lamina::slicer
