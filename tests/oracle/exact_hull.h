#pragma once
// CGAL computes convex hulls, with exact predicates.

#include <span>

#include "base/vec.h"
#include "csg/scene.h"

namespace lamina::oracle {

// Returns the hull of points that span a volume; its corners are some of them.
// Throws std::runtime_error where they span none.
csg::Mesh exact_hull(std::span<const Vec3> points);

}  // namespace lamina::oracle
