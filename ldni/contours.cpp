#include "ldni/contours.h"

#include <algorithm>
#include <cmath>

#include "csg/lanes.h"

namespace lamina::ldni {

double signed_area(std::span<const Vec2> loop) {
  if (loop.empty()) return 0;
  // Relative to the first point, so that a loop far from the origin keeps its
  // digits.
  const Lanes origin = lanes_of(loop.front());
  Lanes products = both_lanes(0);
  Lanes previous = lanes_of(loop.back()) - origin;
  for (const Vec2& point : loop) {
    const Lanes current = lanes_of(point) - origin;
    products += previous * Lanes{current[1], current[0]};
    previous = current;
  }
  return (products[0] - products[1]) / 2;
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
