#pragma once
// How often a mesh goes round a point.

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "csg/scene.h"

namespace lamina::support {

// By the solid angles of the triangles (Van Oosterom and Strackee 1983); of a
// closed mesh a whole number but for rounding.
inline double winding_number(const csg::Mesh& mesh, const Vec3& p) {
  double angles = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]] - p;
    const Vec3 b = mesh.vertices[t[1]] - p;
    const Vec3 c = mesh.vertices[t[2]] - p;
    const double la = glm::length(a);
    const double lb = glm::length(b);
    const double lc = glm::length(c);
    angles += 2 * std::atan2(glm::dot(a, glm::cross(b, c)),
                             la * lb * lc + glm::dot(a, b) * lc +
                                 glm::dot(b, c) * la + glm::dot(c, a) * lb);
  }
  return angles / (4 * std::numbers::pi);
}

}  // namespace lamina::support
