#pragma once
// Names of the vector types that all stages share. Lengths are millimetres.

#include <glm/mat4x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace lamina {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using Vec4 = glm::dvec4;
using Mat4 = glm::dmat4;

// An affine map: four columns of three rows, the last column the shift.
// world = world_from_leaf * Vec4(leaf, 1).
using Affine = glm::dmat4x3;

// An axis-aligned box; empty where low > high in any coordinate.
struct Box3 {
  Vec3 low = Vec3(1e300);
  Vec3 high = Vec3(-1e300);

  bool is_empty() const {
    return low.x > high.x || low.y > high.y || low.z > high.z;
  }
};

}  // namespace lamina
