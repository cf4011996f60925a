#pragma once
// Leaves as explicit triangles, for code that cannot use the formula; and their
// boxes.

#include "csg/scene.h"

namespace lamina::csg {

// Appends the other mesh's vertices and triangles.
void append(Mesh& mesh, const Mesh& other);

// Returns all lofts and meshes of the leaf in one closed triangle mesh, in leaf
// coordinates, with exactly the vertices of the formula (multiplied, not added
// up). Surfaces of cavities face inwards, so that winding numbers add up.
// Degenerate sides at an apex are left out.
Mesh explicit_mesh(const Leaf& leaf);

// Returns the enclosed volume [mm³]; parts that overlap count as often as they
// do.
double signed_volume(const Mesh& mesh);

// Returns the box of the vertices of `leaf` under `linear` (the shift left
// out). The cost is that of one ring plus one profile, not of all vertices.
Box3 bound_leaf(const Leaf& leaf, const Affine& linear);

}  // namespace lamina::csg
