#pragma once
// Closed formulas that tests compare with.

#include <cmath>
#include <numbers>

namespace lamina::support {

// The area of a regular polygon in a circle of this radius.
inline double polygon_area(int sides, double radius = 1) {
  return sides * radius * radius * std::sin(2 * std::numbers::pi / sides) / 2;
}

}  // namespace lamina::support
