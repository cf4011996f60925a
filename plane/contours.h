#pragma once
// Closed loops of one layer in one flat array, the currency between the
// kinetic ray, the loop builder and the writers.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace lamina::plane {

// Loops one after another; points do not repeat the first one at the end.
// Outer loops run counter-clockwise, holes clockwise, so the sign of the area
// tells which a loop is.
struct Contours {
  std::vector<Vec2> points;
  std::vector<std::uint32_t> ends;  // loop i: points [ends[i-1], ends[i])

  std::size_t loop_count() const { return ends.size(); }
  std::span<const Vec2> loop(std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : ends[i - 1];
    return {points.data() + begin, ends[i] - begin};
  }
  bool is_empty() const { return ends.empty(); }
  bool operator==(const Contours&) const = default;
  void add_loop(std::span<const Vec2> loop) {
    points.insert(points.end(), loop.begin(), loop.end());
    ends.push_back(static_cast<std::uint32_t>(points.size()));
  }
  void clear() {
    points.clear();
    ends.clear();
  }
};

}  // namespace lamina::plane
