#pragma once
// CGAL computes convex hulls, with exact predicates.

#include <span>

#include "base/vec.h"
#include "csg/scene.h"

namespace lamina::oracle {

// Returns the hull of points that span a volume; its corners are some of them.
// Throws std::runtime_error where they span none.
csg::Mesh exact_hull(std::span<const Vec3> points);

// +1 where d lies above the plane of a, b, c, -1 below, 0 in it.
int exact_orientation(const Vec3& a, const Vec3& b, const Vec3& c,
                      const Vec3& d);

}  // namespace lamina::oracle
