#include "csg/limits.h"

#include <fmt/format.h>

namespace lamina::csg {

void require_fragments(double count) {
  if (count <= kMostFragments) return;
  throw LimitExceeded(
      fmt::format("Too many fragments: {:.7g} of a circle, at most {:.7g} can "
                  "be ($fn; $fa and $fs; --chordal-error)",
                  count, kMostFragments));
}

void require_triangles(double count) {
  if (count <= kMostTriangles) return;
  throw LimitExceeded(fmt::format(
      "Too many triangles: {:.3g} of one part, at most {:.3g} can be", count,
      kMostTriangles));
}

void require_heights(std::size_t columns, std::size_t rows) {
  if (static_cast<double>(columns) * static_cast<double>(rows) <=
      kMostHeights) {
    return;
  }
  throw LimitExceeded(fmt::format(
      "Too many heights: {} x {} of a surface, at most {:.7g} can be", columns,
      rows, kMostHeights));
}

void require_corners(std::size_t count) {
  if (static_cast<double>(count) <= kMostCorners) return;
  throw LimitExceeded(fmt::format(
      "Too many corners: {} of an outline, at most {:.7g} can be", count,
      kMostCorners));
}

void fail_too_far() {
  throw LimitExceeded("Coordinates beyond 1e9 mm: too large for exact layers");
}

}  // namespace lamina::csg
