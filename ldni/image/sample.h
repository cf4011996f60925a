#pragma once
// Samples, where a ray crosses surfaces of leaves, and intervals, the parts of
// a ray inside the solid.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

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

// A stretch of a ray inside the solid, half-open: [enter.depth, exit.depth).
// The two samples are those of the leaves that make the boundary there; their
// normals point out of the solid, so those of a subtracted leaf are reversed.
struct Interval {
  Sample enter;
  Sample exit;

  double length() const { return exit.depth - enter.depth; }
};

// The intervals of all rays of one layer in one flat array: the depth image
// of the result. On every ray they ascend and neither touch nor overlap.
struct LayerIntervals {
  std::vector<Interval> intervals;
  std::vector<std::uint32_t> ends;  // ray j: intervals [ends[j-1], ends[j])

  std::size_t ray_count() const { return ends.size(); }
  std::span<const Interval> ray(std::size_t j) const {
    const std::size_t begin = j == 0 ? 0 : ends[j - 1];
    return {intervals.data() + begin, ends[j] - begin};
  }
  void clear() {
    intervals.clear();
    ends.clear();
  }
};

}  // namespace lamina::ldni
