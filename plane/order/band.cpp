#include "plane/order/band.h"

#include "base/lanes.h"

namespace lamina::plane {

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
  // Two vertices at a time; the last one may be taken twice.
  Lanes lowest = both_lanes(0);
  Lanes highest = lowest;
  const auto take = [&](const Vec2& a, const Vec2& b) {
    const Lanes x = Lanes{a.x, b.x} - both_lanes(left);
    const Lanes distance =
        Lanes{a.y, b.y} - (both_lanes(y) + x * both_lanes(slope));
    lowest = least(lowest, distance);
    highest = greatest(highest, distance);
  };
  for (const Vec2* point = first + 1; point < end; point += 2) {
    take(point[0], point[1]);
  }
  take(*end, *end);
  low = std::min(lowest[0], lowest[1]);
  high = std::max(highest[0], highest[1]);
}

}  // namespace lamina::plane
