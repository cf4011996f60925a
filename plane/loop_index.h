#pragma once
// Finds loops among others by their points.

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "base/vec.h"
#include "plane/contours.h"

namespace lamina::plane {

class LoopIndex {
 public:
  // contours  must outlive it
  explicit LoopIndex(const Contours& contours) : contours_(contours) {
    for (std::size_t i = 0; i < contours.loop_count(); ++i) {
      const Vec2 first = contours.loop(i).front();
      by_first_point_[{first.x, first.y}] = i;
    }
  }

  // The loop with these points, in this order. No value where there is none;
  // nor, perhaps, where another loop begins with the same point.
  std::optional<std::size_t> find(std::span<const Vec2> loop) const {
    const auto found = by_first_point_.find({loop.front().x, loop.front().y});
    if (found == by_first_point_.end() ||
        !std::ranges::equal(contours_.loop(found->second), loop)) {
      return std::nullopt;
    }
    return found->second;
  }

 private:
  const Contours& contours_;
  std::map<std::pair<double, double>, std::size_t> by_first_point_;
};

}  // namespace lamina::plane
