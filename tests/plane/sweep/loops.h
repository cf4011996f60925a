#pragma once
// Loops that tests sweep.

#include <vector>

#include "base/vec.h"

namespace lamina::plane {

using Loop = std::vector<Vec2>;

inline Loop diamond(const Vec2& centre, double radius) {
  return {centre + Vec2(-radius, 0), centre + Vec2(0, -radius),
          centre + Vec2(radius, 0), centre + Vec2(0, radius)};
}

}  // namespace lamina::plane
