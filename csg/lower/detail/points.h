#pragma once
// Points and indices as the user gave them.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include <fmt/format.h>

#include "base/diagnostic.h"

namespace lamina::csg {

// Reports the first malformed point; returns whether there is none.
//
// type  "vec2" or "vec3"
inline bool check_points(std::string_view wrong_point, std::string_view type,
                         SourceRange range, Diagnostics& diagnostics) {
  if (wrong_point.empty()) return true;
  diagnostics.error(
      range, fmt::format("Unable to convert {} to a {} of numbers", wrong_point,
                         type));
  return false;
}

// index  as OpenSCAD shows it
// list   "faces" or "paths"
inline void warn_of_index(std::uint64_t index, std::string_view list,
                          std::size_t i, std::size_t k, SourceRange range,
                          Diagnostics& diagnostics) {
  diagnostics.warning(range,
                      fmt::format("Point index {} is out of bounds (from "
                                  "{}[{}][{}])",
                                  index, list, i, k));
}

}  // namespace lamina::csg
