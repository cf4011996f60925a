#pragma once
// CGAL measures how far surfaces, or places, are from a surface.

#include <vector>

#include "csg/scene.h"

namespace lamina::oracle {

// The greatest distance of a point of `from` from `to`, or up to `error` more
// or less. Triangles of no area count for nothing; both meshes may be open.
double surface_distance(const csg::Mesh& from, const csg::Mesh& to,
                        double error);

// The distance of each place from the surface.
std::vector<double> distances_from(const csg::Mesh& surface,
                                   const std::vector<Vec3>& places);

}  // namespace lamina::oracle
