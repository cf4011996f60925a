#include "plane/chains.h"

#include <algorithm>

namespace lamina::plane {

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
