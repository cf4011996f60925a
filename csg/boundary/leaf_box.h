#pragma once
// Boxes of leaves, tight in any position.

#include "csg/scene.h"

namespace lamina::csg {

// Of the vertices of `leaf` under `linear` (the shift left out). The cost is
// that of one ring plus one profile, not of all vertices.
Box3 bound_leaf(const Leaf& leaf, const Affine& linear);

Box3 shift_box(const Box3& box, Vec3 shift);
Box3 unite_boxes(const Box3& a, const Box3& b);
Box3 intersect_boxes(const Box3& a, const Box3& b);

}  // namespace lamina::csg
