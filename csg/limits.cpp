#include "csg/limits.h"

#include <fmt/format.h>

namespace lamina::csg {

void require_fragments(double count) {
  if (count <= kMostFragments) return;
  throw plane::LimitExceeded(
      fmt::format("Too many fragments: {:.7g} of a circle, at most {:.7g} can "
                  "be ($fn; $fa and $fs; --chordal-error)",
                  count, kMostFragments));
}

void require_triangles(double count) {
  if (count <= kMostTriangles) return;
  throw plane::LimitExceeded(fmt::format(
      "Too many triangles: {:.3g} of one part, at most {:.3g} can be", count,
      kMostTriangles));
}

void require_heights(std::size_t columns, std::size_t rows) {
  if (static_cast<double>(columns) * static_cast<double>(rows) <=
      kMostHeights) {
    return;
  }
  throw plane::LimitExceeded(fmt::format(
      "Too many heights: {} x {} of a surface, at most {:.7g} can be", columns,
      rows, kMostHeights));
}

}  // namespace lamina::csg
