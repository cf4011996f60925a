#include "slicer/picture/detail/layer_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plane/predicates.h"
#include "slicer/contour/layer_edges.h"

namespace lamina::slicer {
namespace {

// Rows of a layer, at most; else half as many as it has edges.
constexpr std::size_t kMostRows = 512;

}  // namespace

LayerDistance::LayerDistance(const plane::Contours& contours, double reach)
    : reach_(reach) {
  if (contours.is_empty()) return;
  const auto [lowest, highest] =
      std::ranges::minmax_element(contours.points, {}, &Vec2::y);
  low_ = lowest->y;
  const std::size_t rows =
      std::clamp<std::size_t>(contours.points.size() / 2, 1, kMostRows);
  row_height_ = std::max((highest->y - low_) / static_cast<double>(rows),
                         std::numeric_limits<double>::min());

  row_count_ = static_cast<int>(rows);
  edges_.fill(rows, [&](const auto& list) {
    visit_edges(contours, [&](Vec2 from, Vec2 to) {
      const auto [first, last] = std::minmax({row_of(from.y), row_of(to.y)});
      for (int row = first; row <= last; ++row) {
        list(static_cast<std::size_t>(row), Edge{from, to});
      }
    });
  });
}

int LayerDistance::row_of(double y) const {
  return static_cast<int>(
      std::clamp((y - low_) / row_height_, 0.0, row_count_ - 1.0));
}

bool LayerDistance::is_inside(Vec2 place) const {
  int winding = 0;
  for (const auto& [from, to] : edges_of(row_of(place.y))) {
    winding += crossing(from, to, place);
  }
  return winding != 0;
}

LayerDistance::Depth LayerDistance::at(Vec2 place) const {
  if (row_count_ == 0) return {-reach_, Vec2(0)};
  double nearest = reach_ * reach_;
  Vec2 away(0);
  Vec2 along(0);
  const auto look = [&](int row) {
    for (const auto& [from, to] : edges_of(row)) {
      const Vec2 step = to - from;
      const Vec2 to_place = place - from;
      const Vec2 from_edge = to_place - nearest_share(place, from, to) * step;
      const double distance = dot(from_edge, from_edge);
      if (distance < nearest) {
        nearest = distance;
        away = from_edge;
        along = step;
      }
    }
  };
  // From the row of the place outwards, while a row can hold a nearer edge.
  const int middle = row_of(place.y);
  look(middle);
  for (const int step : {-1, 1}) {
    for (int row = middle + step; row >= 0 && row < row_count_; row += step) {
      const double side = low_ + (step < 0 ? row + 1 : row) * row_height_;
      const double gap = (side - place.y) * step;
      if (gap > 0 && gap * gap >= nearest) break;
      look(row);
    }
  }

  const double sign = is_inside(place) ? 1 : -1;
  if (along == Vec2(0)) return {sign * reach_, Vec2(0)};
  const double distance = std::sqrt(nearest);
  // On the edge itself, or nearly so: its left side is the inside.
  constexpr double kOnEdge = 1e-6;  // [mm]
  if (distance < kOnEdge) {
    const double length = std::hypot(along.x, along.y);
    return {sign * distance, left_of(along) / length};
  }
  return {sign * distance, sign * away / distance};
}

}  // namespace lamina::slicer
