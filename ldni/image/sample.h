#pragma once
// A sample: where a ray crosses the surface of a leaf.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <glm/vec3.hpp>

#include "base/vec.h"

namespace lamina::ldni {

// Rays run along +y, so the ray enters the leaf where the normal's y is
// negative and leaves it where y is positive. y is never 0: a sampler that
// meets a face almost parallel to the ray gives it the sign that the leaf's
// contour has there.
struct Sample {
  double depth = 0;                        // y [mm]
  glm::vec3 normal = glm::vec3(0, -1, 0);  // of the face, unit, outwards
  std::uint32_t instance = 0;              // into csg::Scene::instances

  bool is_entry() const { return normal.y < 0; }
};

// Returns `normal` as that of an entry or an exit. Where a face is almost
// parallel to the rays, rounding must not turn one into the other.
inline glm::vec3 sample_normal(const Vec3& normal, bool is_entry) {
  glm::vec3 result(normal);
  const float y =
      std::max(std::abs(result.y), std::numeric_limits<float>::min());
  result.y = is_entry ? -y : y;
  return result;
}

}  // namespace lamina::ldni
