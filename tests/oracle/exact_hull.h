#pragma once
// Convex hulls by CGAL, with exact predicates.

#include <span>

#include "base/vec.h"
#include "csg/scene.h"

namespace lamina::oracle {

// The hull of points that span a volume, its corners some of them. Throws
// std::runtime_error where they span none.
csg::Mesh exact_hull(std::span<const Vec3> points);

}  // namespace lamina::oracle
