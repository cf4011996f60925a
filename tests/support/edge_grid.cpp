#include "tests/support/edge_grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lamina::support {
namespace {

// More cells than this cost more to clear than they save.
constexpr double kMostCells = 4e6;

std::size_t clamp_index(double value, std::size_t count) {
  return static_cast<std::size_t>(
      std::clamp(std::floor(value), 0.0, static_cast<double>(count - 1)));
}

}  // namespace

std::vector<Edge> edges_of(const plane::Contours& contours) {
  std::vector<Edge> edges;
  edges.reserve(contours.points.size());
  for (std::size_t l = 0; l < contours.loop_count(); ++l) {
    const auto loop = contours.loop(l);
    const auto first = static_cast<std::uint32_t>(edges.size());
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const bool is_last = i + 1 == loop.size();
      const auto next = static_cast<std::uint32_t>(edges.size() + 1);
      edges.push_back({loop[i], is_last ? loop[0] : loop[i + 1],
                       static_cast<std::uint32_t>(l), is_last ? first : next});
    }
  }
  return edges;
}

EdgeGrid::EdgeGrid(std::span<const Edge> edges, double margin)
    : edges_(edges), margin_(margin) {
  Vec2 high(0);
  if (!edges.empty()) low_ = high = edges[0].from;
  for (const Edge& edge : edges) {
    low_ = {std::min(low_.x, edge.from.x), std::min(low_.y, edge.from.y)};
    high = {std::max(high.x, edge.from.x), std::max(high.y, edge.from.y)};
  }

  // Square cells, about one an edge.
  const double width = std::max(high.x - low_.x, 4 * margin + 1e-6);
  const double height = std::max(high.y - low_.y, 4 * margin + 1e-6);
  const double wanted =
      std::clamp(static_cast<double>(edges.size()), 1.0, kMostCells);
  const double side = std::sqrt(width * height / wanted);
  columns_ = static_cast<std::size_t>(std::clamp(width / side, 1.0, wanted));
  rows_ = static_cast<std::size_t>(std::clamp(height / side, 1.0, wanted));
  cell_size_ = {width / static_cast<double>(columns_),
                height / static_cast<double>(rows_)};

  // Count, then fill.
  starts_.assign(cell_count() + 1, 0);
  for (const Edge& edge : edges) {
    visit_cells(edge, [&](std::size_t cell) { ++starts_[cell + 1]; });
  }
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  members_.resize(starts_.back());
  std::vector<std::size_t> fill(starts_.begin(), starts_.end() - 1);
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    visit_cells(edges[e],
                [&](std::size_t cell) { members_[fill[cell]++] = e; });
  }
}

std::size_t EdgeGrid::column_at(double x) const {
  return clamp_index((x - low_.x) / cell_size_.x, columns_);
}

std::size_t EdgeGrid::row_at(double y) const {
  return clamp_index((y - low_.y) / cell_size_.y, rows_);
}

template <typename Visit>
void EdgeGrid::visit_cells(const Edge& edge, Visit visit) const {
  const auto [y_low, y_high] = std::minmax(edge.from.y, edge.to.y);
  const auto [x_low, x_high] = std::minmax(edge.from.x, edge.to.x);
  const double slope =
      y_high > y_low ? (edge.to.x - edge.from.x) / (edge.to.y - edge.from.y)
                     : 0;
  const std::size_t last_row = row_at(y_high + margin_);
  for (std::size_t row = row_at(y_low - margin_); row <= last_row; ++row) {
    // The edge's reach in x within this row, generously.
    double left = x_low;
    double right = x_high;
    if (slope != 0) {
      const double bottom =
          low_.y + static_cast<double>(row) * cell_size_.y - margin_;
      const double top = bottom + cell_size_.y + 2 * margin_;
      const double a =
          edge.from.x + (std::max(bottom, y_low) - edge.from.y) * slope;
      const double b =
          edge.from.x + (std::min(top, y_high) - edge.from.y) * slope;
      left = std::max(left, std::min(a, b));
      right = std::min(right, std::max(a, b));
    }
    const std::size_t last_column = column_at(right + margin_);
    for (std::size_t c = column_at(left - margin_); c <= last_column; ++c) {
      visit(row * columns_ + c);
    }
  }
}

int EdgeGrid::winding_number(Vec2 point, std::uint32_t skipped_loop) const {
  int winding = 0;
  const std::size_t row = row_at(point.y);
  const std::size_t last_column = column_at(point.x);
  for (std::size_t column = 0; column <= last_column; ++column) {
    for (const std::uint32_t e : cell(row * columns_ + column)) {
      const Edge& edge = edges_[e];
      if (edge.loop == skipped_loop) continue;
      const bool from_above = edge.from.y > point.y;
      if (from_above == (edge.to.y > point.y)) continue;
      const double x = edge.from.x + (point.y - edge.from.y) *
                                         (edge.to.x - edge.from.x) /
                                         (edge.to.y - edge.from.y);
      // An edge stands in several cells: the one of the crossing counts it.
      if (x >= point.x || column_at(x) != column) continue;
      winding += from_above ? 1 : -1;
    }
  }
  return winding;
}

}  // namespace lamina::support
