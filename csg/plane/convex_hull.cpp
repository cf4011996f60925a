#include "csg/plane/convex_hull.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "base/plane.h"

namespace lamina::planar {
namespace {

// Appends the corners that a walk through the points keeps to its left, the
// last point left out: the other half begins with it.
template <typename Iterator>
void append_half(Iterator begin, Iterator end, Contour& contour) {
  const std::size_t base = contour.size();
  for (Iterator point = begin; point != end; ++point) {
    while (contour.size() >= base + 2 &&
           orientation(contour[contour.size() - 2], contour.back(), *point) <=
               0) {
      contour.pop_back();
    }
    contour.push_back(*point);
  }
  contour.pop_back();
}

}  // namespace

// Andrew's monotone chain: "Another efficient algorithm for convex hulls in two
// dimensions", Information Processing Letters, 1979.
Region convex_hull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(), precedes);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return {};
  Contour contour;
  append_half(points.begin(), points.end(), contour);
  append_half(points.rbegin(), points.rend(), contour);
  if (contour.size() < 3) return {};
  return {{std::move(contour)}};
}

}  // namespace lamina::planar
