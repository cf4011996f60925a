#include "slicer/picture/detail/layer_distance.h"

#include <cmath>
#include <cstddef>

#include "plane/predicates.h"

namespace lamina::slicer {

LayerDistance::Depth LayerDistance::at(Vec2 place) const {
  const double sign = edges_.winding_number(place) != 0 ? 1 : -1;
  double distance = reach_;
  std::size_t nearest = 0;
  edges_.lower(place, 0, distance, nearest);
  if (!(distance < reach_)) return {sign * reach_, Vec2(0)};
  const Vec2 from = edges_.from(nearest);
  const Vec2 to = edges_.to(nearest);
  // On the edge itself, or nearly so: its left side is the inside.
  constexpr double kOnEdge = 1e-6;  // [mm]
  if (distance < kOnEdge) {
    const Vec2 along = to - from;
    const double length = std::hypot(along.x, along.y);
    return {sign * distance, length > 0 ? left_of(along) / length : Vec2(0)};
  }
  const Vec2 away = place - from - nearest_share(place, from, to) * (to - from);
  return {sign * distance, sign * away / distance};
}

}  // namespace lamina::slicer
