#include "ldni/contours.h"

#include <algorithm>
#include <cmath>

#include "csg/lanes.h"

namespace lamina::ldni {

double signed_area(std::span<const Vec2> loop) {
  if (loop.empty()) return 0;
  // Relative to the first point, so that a loop far from the origin keeps its
  // digits.
  const Vec2 origin = loop.front();
  double doubled = 0;
  Vec2 previous = loop.back() - origin;
  for (const Vec2& point : loop) {
    const Vec2 current = point - origin;
    doubled += previous.x * current.y - previous.y * current.x;
    previous = current;
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

double greatest_coordinate(std::span<const Vec2> points) {
  Lanes low = both_lanes(0);
  Lanes high = both_lanes(0);
  for (const Vec2& point : points) {
    low = least(low, lanes_of(point));
    high = greatest(high, lanes_of(point));
  }
  const Lanes reach = greatest(high, -low);
  return std::max(reach[0], reach[1]);
}

}  // namespace lamina::ldni
