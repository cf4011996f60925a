#include "plane/chains.h"

#include <algorithm>

namespace lamina::plane {

double y_at(std::span<const Vec2> points, double x) {
  const auto right = std::ranges::upper_bound(
      points.subspan(1, points.size() - 2), x, {}, &Vec2::x);
  const Vec2& a = *(right - 1);
  const Vec2& b = *right;
  if (x == b.x) return b.y;
  return a.y + (x - a.x) * (b.y - a.y) / (b.x - a.x);
}

bool ChainBlock::repeats(std::uint32_t i) const {
  if (i == 0) return false;
  const auto is_same = [this](const Chain& a, const Chain& b) {
    if (a.operand != b.operand || a.winding != b.winding) return false;
    // Where one wall was cut once for both, they have the same points.
    return (a.first_point == b.first_point && a.point_count == b.point_count) ||
           std::ranges::equal(a.points_in(points), b.points_in(points));
  };
  return std::ranges::equal(layer(i), layer(i - 1), is_same) &&
         std::ranges::equal(loops_of(i), loops_of(i - 1));
}

}  // namespace lamina::plane
