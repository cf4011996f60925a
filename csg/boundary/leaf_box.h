#pragma once
// Boxes of leaves, tight in any position.

#include "csg/scene.h"

namespace lamina::csg {

// Of the vertices of `leaf` under `linear` (the shift left out). The cost is
// that of one ring plus one profile, not of all vertices.
Box3 bound_leaf(const Leaf& leaf, const Affine& linear);

}  // namespace lamina::csg
