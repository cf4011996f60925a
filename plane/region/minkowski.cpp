#include "plane/region/minkowski.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "plane/loop_area.h"
#include "plane/predicates.h"
#include "plane/region/boolean.h"
#include "plane/region/convex_faces.h"
#include "plane/region/triangulate.h"

namespace lamina::plane {
namespace {

// The lowest point, of these the leftmost: where directions begin.
std::size_t lowest(const Contour& contour) {
  const auto point = std::min_element(
      contour.begin(), contour.end(), [](const Vec2& a, const Vec2& b) {
        return a.y != b.y ? a.y < b.y : a.x < b.x;
      });
  return static_cast<std::size_t>(point - contour.begin());
}

Vec2 at(const Contour& contour, std::size_t i) {
  return contour[i % contour.size()];
}

// The sums of pairs of convex pieces. A union takes some kilobytes of memory
// for each of its operands, so few of them are united at once.
struct PairSums {
  static constexpr std::size_t kMostAtOnce = 4096;

  std::span<const Contour> a;
  std::span<const Contour> b;

  // Pairs are numbered part of `a` by part of `a`.
  Region unite(std::size_t begin, std::size_t end) const {
    std::vector<Region> parts;
    if (end - begin <= kMostAtOnce) {
      for (std::size_t i = begin; i < end; ++i) {
        parts.push_back({{add_convex(a[i / b.size()], b[i % b.size()])}});
      }
    } else {
      const std::size_t middle = begin + (end - begin) / 2;
      parts.push_back(unite(begin, middle));
      parts.push_back(unite(middle, end));
    }
    return plane::unite(parts);
  }
};

}  // namespace

std::vector<Contour> cut_into_convex(const Region& region) {
  std::vector<Vec3> points;
  for (const Contour& contour : region.contours) {
    for (const Vec2 p : contour) points.emplace_back(p.x, p.y, 0);
  }
  std::vector<Contour> pieces;
  for (const Face& face : merge_to_convex(points, triangulate(region))) {
    Contour piece;
    for (const std::uint32_t corner : face.corners) {
      piece.emplace_back(points[corner].x, points[corner].y);
    }
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

Contour add_convex(const Contour& a, const Contour& b) {
  const std::size_t a_begin = lowest(a);
  const std::size_t b_begin = lowest(b);
  Contour sum;
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() || j < b.size()) {
    const Vec2 a_corner = at(a, a_begin + i);
    const Vec2 b_corner = at(b, b_begin + j);
    sum.push_back(a_corner + b_corner);
    const int order = i == a.size() ? 1
                      : j == b.size()
                          ? -1
                          : compare_angles(at(a, a_begin + i + 1) - a_corner,
                                           at(b, b_begin + j + 1) - b_corner);
    if (order <= 0) ++i;
    if (order >= 0) ++j;
  }
  return sum;
}

Region add(const Region& a, const Region& b) {
  const std::vector<Contour> a_pieces = cut_into_convex(a);
  const std::vector<Contour> b_pieces = cut_into_convex(b);
  const std::size_t pairs = a_pieces.size() * b_pieces.size();
  return pairs == 0 ? Region{} : PairSums{a_pieces, b_pieces}.unite(0, pairs);
}

Region fill(const Region& region) {
  std::vector<Region> outer;
  for (const Contour& contour : region.contours) {
    if (sliver_area(contour) > 0) outer.push_back({{contour}});
  }
  return outer.empty() ? Region{} : unite(outer);
}

}  // namespace lamina::plane
