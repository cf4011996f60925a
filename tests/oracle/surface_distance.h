#pragma once
// CGAL measures how far one surface is from another.

#include "csg/scene.h"

namespace lamina::oracle {

// The greatest distance of a point of `from` from `to`, or up to `error` more
// or less. Triangles of no area count for nothing; both meshes may be open.
double surface_distance(const csg::Mesh& from, const csg::Mesh& to,
                        double error);

}  // namespace lamina::oracle
