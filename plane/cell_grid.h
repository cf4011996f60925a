#pragma once
// A grid of equal cells over a part of the plane, and lists by cell: what finds
// points and edges by place.
//
// The grid only counts: columns, rows, and the cells that a segment comes near
// to. The lists follow each other in one array, so that the cells of
// a row that follow each other are one stretch of it.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace lamina {

class CellGrid {
 public:
  // One cell, the plane.
  CellGrid() = default;
  // At least one column and one row of cells, from `low` on.
  CellGrid(Vec2 low, Vec2 cells_per_mm, std::uint32_t columns,
           std::uint32_t rows)
      : low_(low),
        cells_per_mm_(cells_per_mm),
        columns_(columns),
        rows_(rows) {}
  // About `count` square cells over the box, none smaller than `least` [mm].
  CellGrid(double count, const Box2& box, double least)
      : CellGrid(box,
                 1 / std::max({std::sqrt(box.size().x * box.size().y / count),
                               std::max(box.size().x, box.size().y) / count,
                               least})) {}
  // As many square cells as the box needs.
  CellGrid(const Box2& box, double cells_per_mm)
      : CellGrid(box.low, Vec2(cells_per_mm),
                 1 + static_cast<std::uint32_t>(box.size().x * cells_per_mm),
                 1 + static_cast<std::uint32_t>(box.size().y * cells_per_mm)) {}

  std::size_t size() const { return std::size_t{columns_} * rows_; }
  Vec2 cells_per_mm() const { return cells_per_mm_; }

  // What lies outside counts to the border.
  std::uint32_t column_of(double x) const {
    return place((x - low_.x) * cells_per_mm_.x, columns_);
  }
  std::uint32_t row_of(double y) const {
    return place((y - low_.y) * cells_per_mm_.y, rows_);
  }
  // Cells are numbered row by row.
  std::size_t cell(std::uint32_t column, std::uint32_t row) const {
    return std::size_t{row} * columns_ + column;
  }
  std::size_t cell_of(Vec2 point) const {
    return cell(column_of(point.x), row_of(point.y));
  }

  // Calls visit(first, last) row by row, upwards, for the cells within `reach`
  // [mm] of the segment in x and in y, and for some beyond; ends where it
  // returns true. Whether one did. Of a segment that leaves the box of the
  // cells only the part within counts for sure.
  template <typename Visit>
  bool visit_rows(Vec2 a, Vec2 b, Vec2 reach, const Visit& visit) const;

  // Calls visit(cell) for each of these cells.
  template <typename Visit>
  void visit_cells(Vec2 a, Vec2 b, Vec2 reach, const Visit& visit) const {
    visit_rows(a, b, reach, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i <= last; ++i) visit(i);
      return false;
    });
  }

 private:
  static std::uint32_t place(double cells, std::uint32_t count) {
    return static_cast<std::uint32_t>(
        std::clamp(cells, 0.0, static_cast<double>(count - 1)));
  }

  Vec2 low_ = Vec2(0);
  Vec2 cells_per_mm_ = Vec2(0);
  std::uint32_t columns_ = 1;
  std::uint32_t rows_ = 1;
};

template <typename Visit>
bool CellGrid::visit_rows(Vec2 a, Vec2 b, Vec2 reach,
                          const Visit& visit) const {
  const Vec2 lower = a.y <= b.y ? a : b;
  const Vec2 upper = a.y <= b.y ? b : a;
  const std::uint32_t first_row = row_of(lower.y - reach.y);
  const std::uint32_t last_row = row_of(upper.y + reach.y);
  // What is level, or spans few rows, is taken whole in each.
  const bool is_whole = last_row - first_row < 2 || lower.y == upper.y;
  const double slope = is_whole ? 0 : (upper.x - lower.x) / (upper.y - lower.y);
  for (std::uint32_t row = first_row; row <= last_row; ++row) {
    double x0 = lower.x;
    double x1 = upper.x;
    if (!is_whole) {
      // The part of the segment that comes near to this row.
      const double bottom = low_.y + row / cells_per_mm_.y - reach.y;
      const double top = low_.y + (row + 1) / cells_per_mm_.y + reach.y;
      x0 += slope * (std::clamp(bottom, lower.y, upper.y) - lower.y);
      x1 = lower.x + slope * (std::clamp(top, lower.y, upper.y) - lower.y);
    }
    const std::uint32_t first = column_of(std::min(x0, x1) - reach.x);
    const std::uint32_t last = column_of(std::max(x0, x1) + reach.x);
    if (visit(cell(first, row), cell(last, row))) return true;
  }
  return false;
}

// Lists items by cell; an item may be in several lists.
template <typename Item>
class CellLists {
 public:
  // Replaces all lists. `for_each` calls its argument, a function of a cell and
  // an item, for all that is to be listed; it is called twice and does the same
  // both times. Items of a cell keep the order in which they came.
  template <typename ForEach>
  void fill(std::size_t cells, const ForEach& for_each) {
    // Sort by counting. Two entries ahead, so that the begins that move up
    // while the lists fill are their ends afterwards.
    starts_.assign(cells + 2, 0);
    for_each([this](std::size_t cell, const Item&) { ++starts_[cell + 2]; });
    for (std::size_t i = 2; i < starts_.size(); ++i) {
      starts_[i] += starts_[i - 1];
    }
    items_.resize(starts_.back());
    for_each([this](std::size_t cell, const Item& item) {
      items_[starts_[cell + 1]++] = item;
    });
  }

  std::span<const Item> operator[](std::size_t cell) const {
    return between(cell, cell);
  }
  // The items of the cells from `first` to `last`.
  std::span<const Item> between(std::size_t first, std::size_t last) const {
    return {items_.data() + starts_[first], starts_[last + 1] - starts_[first]};
  }

 private:
  std::vector<std::uint32_t> starts_{0, 0};  // of each cell, in items_
  std::vector<Item> items_;
};

}  // namespace lamina
