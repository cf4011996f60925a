#include "plane/loop_area.h"

#include <cmath>
#include <cstddef>

#include "plane/predicates.h"

namespace lamina {

double signed_area(std::span<const Vec2> loop) {
  if (loop.empty()) return 0;
  DoubledArea area(loop.front(), loop.back());
  for (const Vec2& point : loop) area.add(point);
  return area.value() / 2;
}

double sliver_area(std::span<const Vec2> loop) {
  double doubled = 0;
  for (std::size_t i = 2; i < loop.size(); ++i) {
    doubled += cross(loop[i - 1] - loop[0], loop[i] - loop[0]);
  }
  return doubled / 2;
}

double perimeter(std::span<const Vec2> loop) {
  double length = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 step = loop[(i + 1) % loop.size()] - loop[i];
    length += std::hypot(step.x, step.y);
  }
  return length;
}

Box2 box_of(std::span<const Vec2> points) {
  Lanes low = both_lanes(Box2().low.x);
  Lanes high = both_lanes(Box2().high.x);
  for (const Vec2& point : points) {
    low = least(low, lanes_of(point));
    high = greatest(high, lanes_of(point));
  }
  return {point_of(low), point_of(high)};
}

double greatest_coordinate(std::span<const Vec2> points) {
  Reach reach;
  for (const Vec2& point : points) reach.add(point);
  return reach.value();
}

}  // namespace lamina
