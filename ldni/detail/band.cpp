#include "ldni/detail/band.h"

namespace lamina::ldni::detail {

void Band::enclose(const Vec2* first, const Vec2* last, double limit) {
  const Vec2* end = last;
  if (last->x >= limit) {
    end = first + 1;
    while (end->x < limit) ++end;
  }
  right = end->x;
  ends_chain = end == last;
  const double steepness = (end->y - first->y) / (right - left);
  if (std::abs(steepness) <= kSteepest) slope = steepness;
  for (const Vec2* point = first + 1; point <= end; ++point) {
    const double distance = point->y - (y + (point->x - left) * slope);
    low = std::min(low, distance);
    high = std::max(high, distance);
  }
}

}  // namespace lamina::ldni::detail
