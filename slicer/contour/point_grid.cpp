#include "slicer/contour/point_grid.h"

#include <cmath>

namespace lamina::slicer {

void PointGrid::fill(std::span<const Vec2> points,
                     std::span<const std::uint32_t> members) {
  members_.resize(members.size());
  if (members.empty()) return;
  Vec2 high = low_ = points[members.front()];
  for (const std::uint32_t i : members) {
    const Vec2& p = points[i];
    low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const Vec2 size = high - low_;
  const double wanted = 2.0 * static_cast<double>(members.size());
  // Points on a line, or in one place, have no area.
  const double longest = std::max({size.x, size.y, 1e-9});
  cells_per_mm_ = std::min(
      std::sqrt(wanted / std::max(size.x * size.y, 1e-300)), wanted / longest);
  columns_ = 1 + static_cast<std::uint32_t>(size.x * cells_per_mm_);
  rows_ = 1 + static_cast<std::uint32_t>(size.y * cells_per_mm_);

  // Sort by cell: count, sum up, and deal out from the back.
  starts_.assign(std::size_t{columns_} * rows_ + 1, 0);
  cell_of_.resize(members.size());
  for (std::size_t k = 0; k < members.size(); ++k) {
    const Vec2& p = points[members[k]];
    cell_of_[k] = row_of(p.y) * columns_ + column_of(p.x);
    ++starts_[cell_of_[k]];
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& start : starts_) start = sum += start;
  for (std::size_t k = members.size(); k-- > 0;) {
    members_[--starts_[cell_of_[k]]] = members[k];
  }
}

}  // namespace lamina::slicer
