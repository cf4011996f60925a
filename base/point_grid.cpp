#include "base/point_grid.h"

#include <cmath>

#include <glm/common.hpp>

namespace lamina {

void PointGrid::fill(std::span<const Vec2> points,
                     std::span<const std::uint32_t> members) {
  grid_ = {};
  if (!members.empty()) {
    Vec2 low = points[members.front()];
    Vec2 high = low;
    for (const std::uint32_t i : members) {
      low = glm::min(low, points[i]);
      high = glm::max(high, points[i]);
    }
    const Vec2 size = high - low;
    const double wanted = 2.0 * static_cast<double>(members.size());
    // Points on a line, or in one place, have no area.
    const double longest = std::max({size.x, size.y, 1e-9});
    grid_ = {low, high,
             std::min(std::sqrt(wanted / std::max(size.x * size.y, 1e-300)),
                      wanted / longest)};
  }
  members_.fill(grid_.size(), [&](const auto& list) {
    for (const std::uint32_t i : members) list(grid_.cell_of(points[i]), i);
  });
}

}  // namespace lamina
