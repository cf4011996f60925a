#include "slicer/picture/detail/layer_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lamina::slicer {
namespace {

// Rows of a layer, at most; else half as many as it has edges.
constexpr std::size_t kMostRows = 512;

}  // namespace

LayerDistance::LayerDistance(const ldni::Contours& contours, double reach)
    : reach_(reach) {
  if (contours.is_empty()) return;
  const auto [lowest, highest] = std::minmax_element(
      contours.points.begin(), contours.points.end(),
      [](const Vec2& a, const Vec2& b) { return a.y < b.y; });
  low_ = lowest->y;
  const std::size_t rows =
      std::clamp<std::size_t>(contours.points.size() / 2, 1, kMostRows);
  row_height_ = std::max((highest->y - low_) / static_cast<double>(rows),
                         std::numeric_limits<double>::min());

  std::vector<std::uint32_t> counts(rows);
  row_ends_.resize(rows);
  const auto for_edges = [&](const auto& visit) {
    for (std::size_t i = 0; i < contours.loop_count(); ++i) {
      const auto loop = contours.loop(i);
      for (std::size_t j = 0; j < loop.size(); ++j) {
        const Edge edge = {loop[j], loop[(j + 1) % loop.size()]};
        const auto [first, last] =
            std::minmax({row_of(edge.from.y), row_of(edge.to.y)});
        for (int row = first; row <= last; ++row) {
          visit(edge, static_cast<std::size_t>(row));
        }
      }
    }
  };
  for_edges([&](const Edge&, std::size_t row) { ++row_ends_[row]; });
  for (std::size_t row = 1; row < rows; ++row) {
    row_ends_[row] += row_ends_[row - 1];
  }
  edges_.resize(row_ends_.back());
  for_edges([&](const Edge& edge, std::size_t row) {
    const std::uint32_t begin = row == 0 ? 0 : row_ends_[row - 1];
    edges_[begin + counts[row]++] = edge;
  });
}

int LayerDistance::row_of(double y) const {
  const double row = (y - low_) / row_height_;
  return static_cast<int>(
      std::clamp(row, 0.0, static_cast<double>(row_ends_.size()) - 1));
}

std::span<const LayerDistance::Edge> LayerDistance::edges_of(int row) const {
  const auto number = static_cast<std::size_t>(row);
  const std::uint32_t begin = number == 0 ? 0 : row_ends_[number - 1];
  return {edges_.data() + begin, row_ends_[number] - begin};
}

bool LayerDistance::is_inside(Vec2 place) const {
  int winding = 0;
  for (const auto& [from, to] : edges_of(row_of(place.y))) {
    if ((from.y <= place.y) == (to.y <= place.y)) continue;
    const double x =
        from.x + (to.x - from.x) * (place.y - from.y) / (to.y - from.y);
    if (x < place.x) winding += from.y < to.y ? 1 : -1;
  }
  return winding != 0;
}

LayerDistance::Depth LayerDistance::at(Vec2 place) const {
  if (edges_.empty()) return {-reach_, Vec2(0)};
  double nearest = reach_ * reach_;
  Vec2 away(0);
  Vec2 along(0);
  const auto look = [&](int row) {
    for (const auto& [from, to] : edges_of(row)) {
      const Vec2 step = to - from;
      const Vec2 to_place = place - from;
      const double length = step.x * step.x + step.y * step.y;
      const double share =
          length == 0
              ? 0
              : std::clamp((to_place.x * step.x + to_place.y * step.y) / length,
                           0.0, 1.0);
      const Vec2 from_edge = to_place - share * step;
      const double distance =
          from_edge.x * from_edge.x + from_edge.y * from_edge.y;
      if (distance < nearest) {
        nearest = distance;
        away = from_edge;
        along = step;
      }
    }
  };
  // From the row of the place outwards, while a row can hold a nearer edge.
  const int rows = static_cast<int>(row_ends_.size());
  const int middle = row_of(place.y);
  look(middle);
  for (int row = middle - 1; row >= 0; --row) {
    const double gap = place.y - (low_ + (row + 1) * row_height_);
    if (gap > 0 && gap * gap >= nearest) break;
    look(row);
  }
  for (int row = middle + 1; row < rows; ++row) {
    const double gap = low_ + row * row_height_ - place.y;
    if (gap > 0 && gap * gap >= nearest) break;
    look(row);
  }

  const double sign = is_inside(place) ? 1 : -1;
  if (along == Vec2(0)) return {sign * reach_, Vec2(0)};
  const double distance = std::sqrt(nearest);
  // On the edge itself, or nearly so: its left side is the inside.
  constexpr double kOnEdge = 1e-6;  // [mm]
  if (distance < kOnEdge) {
    const double length = std::hypot(along.x, along.y);
    return {sign * distance, Vec2(-along.y, along.x) / length};
  }
  return {sign * distance, sign * away / distance};
}

}  // namespace lamina::slicer
