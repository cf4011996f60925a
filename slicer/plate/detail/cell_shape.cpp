#include "slicer/plate/detail/cell_shape.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "plane/tie_distance.h"

namespace lamina::slicer {
namespace {

// What is known of one column, in cells.
struct Column {
  std::vector<double> crossings;  // of edges with the line through its middle
  std::vector<std::pair<double, double>> stretches;  // of y
};

// Adds an edge to the columns that it passes.
void add_edge(Vec2 from, Vec2 to, double tie, std::vector<Column>& columns) {
  const Vec2 left = from.x <= to.x ? from : to;
  const Vec2 right = from.x <= to.x ? to : from;
  const bool is_upright = right.x - left.x <= tie;
  const double slope = is_upright ? 0 : (right.y - left.y) / (right.x - left.x);
  const auto y_at = [&](double x) { return left.y + slope * (x - left.x); };
  const auto first = static_cast<std::int32_t>(std::floor(left.x + tie));
  const auto end = static_cast<std::int32_t>(std::ceil(right.x - tie));
  for (std::int32_t i = first; i < end; ++i) {
    Column& column = columns[static_cast<std::size_t>(i)];
    const double y0 = is_upright ? left.y : y_at(std::max<double>(left.x, i));
    const double y1 =
        is_upright ? right.y : y_at(std::min<double>(right.x, i + 1));
    column.stretches.emplace_back(std::min(y0, y1), std::max(y0, y1));
    const double middle = i + 0.5;
    if (left.x <= middle && middle < right.x) {
      column.crossings.push_back(is_upright ? left.y : y_at(middle));
    }
  }
}

// Sorts the stretches and rounds them to runs of cells.
void append_runs(Column& column, double tie, std::vector<CellRun>& runs) {
  std::sort(column.crossings.begin(), column.crossings.end());
  for (std::size_t i = 0; i + 1 < column.crossings.size(); i += 2) {
    column.stretches.emplace_back(column.crossings[i], column.crossings[i + 1]);
  }
  std::sort(column.stretches.begin(), column.stretches.end());
  const std::size_t first = runs.size();
  for (const auto& [low, high] : column.stretches) {
    const auto begin = static_cast<std::int32_t>(std::floor(low + tie));
    const auto end = static_cast<std::int32_t>(std::ceil(high - tie));
    if (begin >= end) continue;
    if (runs.size() > first && begin <= runs.back().end) {
      runs.back().end = std::max(runs.back().end, end);
    } else {
      runs.push_back({begin, end});
    }
  }
}

}  // namespace

CellShape::CellShape(const plane::Region& region, Vec2 origin, double cell) {
  Box2 box;
  for (const plane::Contour& contour : region.contours) box.add(contour);
  if (box.is_empty()) return;
  const double width = (box.high.x - origin.x) / cell;
  std::vector<Column> columns(static_cast<std::size_t>(width) + 1);
  const double tie = kTieDistance / cell;
  for (const plane::Contour& contour : region.contours) {
    Vec2 before = (contour.back() - origin) / cell;
    for (const Vec2 point : contour) {
      const Vec2 here = (point - origin) / cell;
      add_edge(before, here, tie, columns);
      before = here;
    }
  }
  for (Column& column : columns) {
    append_runs(column, tie, runs_);
    ends_.push_back(runs_.size());
  }
}

std::size_t CellShape::cell_count() const {
  std::size_t count = 0;
  for (const CellRun& run : runs_) {
    count += static_cast<std::size_t>(run.end - run.begin);
  }
  return count;
}

}  // namespace lamina::slicer
