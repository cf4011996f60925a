#pragma once
// Points as the user gave them.

#include <cstddef>
#include <span>
#include <string_view>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "parser/diagnostic.h"

namespace lamina::csg {

// Reports the first point that is none: the evaluator leaves a NaN where the
// user wrote no number.
//
// type  "vec2" or "vec3"
template <typename Point>
bool check_points(std::span<const Point> points, std::string_view type,
                  SourceRange range, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    // 0 · x is NaN where x is not finite.
    if (glm::dot(points[i], Point(0)) == 0) continue;
    diagnostics.error(range,
                      fmt::format("Unable to convert points[{}] to a {} of "
                                  "numbers",
                                  i, type));
    return false;
  }
  return true;
}

}  // namespace lamina::csg
