#include "plane/region/region.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "plane/loop_area.h"
#include "plane/predicates.h"

namespace lamina::plane {
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

Box2 box_of(std::span<const Contour> contours) {
  Box2 box;
  for (const Contour& contour : contours) {
    box.add(lamina::box_of(std::span<const Vec2>(contour)));
  }
  return box;
}

double area(const Region& region) {
  double sum = 0;
  for (const Contour& contour : region.contours) sum += sliver_area(contour);
  return sum;
}

std::size_t corner_count(const Region& region) {
  std::size_t count = 0;
  for (const Contour& contour : region.contours) count += contour.size();
  return count;
}

void drop_hairlines(Region& region, double width) {
  std::erase_if(region.contours, [&](const Contour& contour) {
    return std::abs(sliver_area(contour)) < 0.5 * width * perimeter(contour);
  });
}

Region to_region(const Contours& contours) {
  Region region;
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    const std::span<const Vec2> loop = contours.loop(i);
    region.contours.emplace_back(loop.begin(), loop.end());
  }
  return region;
}

Contours to_contours(const Region& region) {
  Contours contours;
  for (const Contour& contour : region.contours) contours.add_loop(contour);
  return contours;
}

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

}  // namespace lamina::plane
