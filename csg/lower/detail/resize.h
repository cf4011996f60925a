#pragma once
// resize(): by how much, with OpenSCAD's rules.

#include "csg/plane/region.h"
#include "csg/scene.h"
#include "csg/tree.h"

namespace lamina::csg {

// A size of 0 keeps that direction, or with `auto` scales it as the direction
// of the greatest new size. So does a negative size, except that it mirrors the
// result of a Boolean (OpenSCAD 2021.01 has other code for that). A direction
// without extent is kept.
Vec2 resize_factor(const Resize& op, const planar::Region& region);
Vec3 resize_factor(const Resize& op, const Scene& scene, bool is_boolean);

}  // namespace lamina::csg
