#include "plane/limits.h"

#include <fmt/format.h>

namespace lamina::plane {

void require_corners(std::size_t count) {
  if (static_cast<double>(count) <= kMostCorners) return;
  throw LimitExceeded(
      fmt::format("Too many corners: {} of an outline, at most {:.7g} can be",
                  count, kMostCorners));
}

void fail_too_far() {
  throw LimitExceeded("Coordinates beyond 1e9 mm: too large for exact layers");
}

}  // namespace lamina::plane
