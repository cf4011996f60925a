#include "slicer/supports/detail/marked_places.h"

#include <cmath>
#include <numbers>

namespace lamina::slicer::detail {

Vec2 side(int k) {
  const double angle = 2 * std::numbers::pi * k / kSides;
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace lamina::slicer::detail
