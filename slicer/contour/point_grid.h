#pragma once
// Points of a layer by place, for the question which of them lie near a
// segment.
//
// A grid of about two cells a point, as one array of points ordered by cell. A
// query walks the cells under the segment row by row.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace lamina::slicer {

class PointGrid {
 public:
  // Forgets what it held. `members` are indices into `points`, which must
  // outlive the queries.
  void fill(std::span<const Vec2> points,
            std::span<const std::uint32_t> members);

  // Calls is_hit(member) for all members within `reach` [mm] of the segment,
  // in x and in y, and for some beyond; returns true at the first that is one.
  template <typename IsHit>
  bool has_near(Vec2 a, Vec2 b, double reach, const IsHit& is_hit) const;

 private:
  std::uint32_t column_of(double x) const { return cell(x - low_.x, columns_); }
  std::uint32_t row_of(double y) const { return cell(y - low_.y, rows_); }
  std::uint32_t cell(double distance, std::uint32_t count) const {
    return static_cast<std::uint32_t>(std::clamp(
        distance * cells_per_mm_, 0.0, static_cast<double>(count - 1)));
  }

  Vec2 low_ = Vec2(0);
  double cells_per_mm_ = 0;
  std::uint32_t columns_ = 1;
  std::uint32_t rows_ = 1;
  std::vector<std::uint32_t> starts_;   // cell → its first in members_
  std::vector<std::uint32_t> members_;  // by cell
  std::vector<std::uint32_t> cell_of_;  // scratch of fill()
};

template <typename IsHit>
bool PointGrid::has_near(Vec2 a, Vec2 b, double reach,
                         const IsHit& is_hit) const {
  if (members_.empty()) return false;
  const Vec2 lower = a.y <= b.y ? a : b;
  const Vec2 upper = a.y <= b.y ? b : a;
  const double slope =
      upper.y > lower.y ? (upper.x - lower.x) / (upper.y - lower.y) : 0;
  const std::uint32_t first_row = row_of(lower.y - reach);
  const std::uint32_t last_row = row_of(upper.y + reach);
  for (std::uint32_t row = first_row; row <= last_row; ++row) {
    // The part of the segment that this row can see.
    double x0 = lower.x;
    double x1 = upper.x;
    if (first_row != last_row && upper.y > lower.y) {
      const double row_low = low_.y + row / cells_per_mm_ - reach;
      const double row_high = low_.y + (row + 1) / cells_per_mm_ + reach;
      x0 += slope * (std::clamp(row_low, lower.y, upper.y) - lower.y);
      x1 = lower.x + slope * (std::clamp(row_high, lower.y, upper.y) - lower.y);
    }
    const std::size_t row_start = std::size_t{row} * columns_;
    const std::uint32_t begin =
        starts_[row_start + column_of(std::min(x0, x1) - reach)];
    const std::uint32_t end =
        starts_[row_start + column_of(std::max(x0, x1) + reach) + 1];
    for (std::uint32_t i = begin; i < end; ++i) {
      if (is_hit(members_[i])) return true;
    }
  }
  return false;
}

}  // namespace lamina::slicer
