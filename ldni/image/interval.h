#pragma once
// Intervals: the parts of a ray inside the solid, which the Boolean returns.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ldni/image/sample.h"

namespace lamina::ldni {

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
