#pragma once
// Coordinates too large for the polygon clipper.

#include <stdexcept>

#include "parser/diagnostic.h"

namespace lamina::csg {

// What `make` returns, or nothing and OpenSCAD's warning where it throws
// std::range_error (see csg/planar/clip.h).
template <typename Make>
auto with_range_check(SourceRange range, Diagnostics& diagnostics, Make make)
    -> decltype(make()) {
  try {
    return make();
  } catch (const std::range_error&) {
    diagnostics.warning(range, "Range check failed for polygon. skipping");
    return {};
  }
}

}  // namespace lamina::csg
