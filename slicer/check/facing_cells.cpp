#include "slicer/check/facing_cells.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <glm/common.hpp>

namespace lamina::slicer {
namespace {

// Cells for each edge, at most: more would cost more to clear than they save.
constexpr double kCellsPerEdge = 4;

// Directions fall into sectors by y / (|x| + |y|), which needs no angle.
// kFacingAngle spans 8.4 of them at most.
constexpr int kSectorsInQuadrant = 16;
constexpr int kSectors = 4 * kSectorsInQuadrant;
constexpr int kReach = 10;
static_assert(kFacingAngle * kSectorsInQuadrant + 1 < kReach);

int sector_of(Vec2 along) {
  const double share = along.y / (std::abs(along.x) + std::abs(along.y));
  const double quadrants = along.x >= 0 ? 1 + share : 3 - share;
  return static_cast<int>(quadrants * kSectorsInQuadrant) % kSectors;
}

// The sectors from `first` counter-clockwise to `last`.
std::uint64_t arc(int first, int last) {
  const int more = (last - first + kSectors) % kSectors;
  const std::uint64_t ones = ~std::uint64_t{0} >> (kSectors - 1 - more);
  return std::rotl(ones, first);
}

std::uint64_t widen(std::uint64_t sectors, int by) {
  return sectors | std::rotl(sectors, by) | std::rotr(sectors, by);
}

// The sectors that face one of these.
std::uint64_t facing(std::uint64_t sectors) {
  static_assert(kReach == 1 + 2 + 4 + 3);
  const std::uint64_t opposite = std::rotl(sectors, kSectors / 2);
  return widen(widen(widen(widen(opposite, 1), 2), 4), 3);
}

// The sectors of an edge and of the turn at its beginning.
std::uint64_t directions_of(const LayerEdge& previous, const LayerEdge& edge) {
  const int before = sector_of(previous.along);
  const int here = sector_of(edge.along);
  return cross(previous.along, edge.along) >= 0 ? arc(before, here)
                                                : arc(here, before);
}

}  // namespace

void FacingCells::build(std::span<const LayerEdge> edges, double width) {
  edges_ = edges;
  // A little more than half the width: rounding must not hide an edge.
  margin_ = width * (0.5 + 1e-6);
  has_facing_ = false;
  if (edges.empty()) return;
  choose_cells();
  mark_directions();
  if (!has_facing_) return;
  list_members();
  last_gather_.assign(edges.size(), 0);
  gather_ = 0;
}

void FacingCells::choose_cells() {
  low_ = edges_.front().from;
  Vec2 high = low_;
  for (const LayerEdge& edge : edges_) {
    low_ = {std::min(low_.x, edge.from.x), std::min(low_.y, edge.from.y)};
    high = {std::max(high.x, edge.from.x), std::max(high.y, edge.from.y)};
  }
  // Long edges must not be listed in too many cells.
  constexpr double kMostCells = 64;
  double way = 0;
  for (const LayerEdge& edge : edges_) {
    const Vec2 along = glm::abs(edge.to() - edge.from);
    way += along.x + along.y;
  }
  const auto count = static_cast<double>(edges_.size());
  const Vec2 size = high - low_;
  const double wanted = kCellsPerEdge * count;
  const double cell =
      std::max({2 * margin_, std::sqrt(size.x * size.y / wanted),
                std::max(size.x, size.y) / wanted, way / (kMostCells * count)});
  cells_per_mm_ = 1 / cell;
  columns_ = 1 + static_cast<std::uint32_t>(size.x * cells_per_mm_);
  rows_ = 1 + static_cast<std::uint32_t>(size.y * cells_per_mm_);
}

std::uint32_t FacingCells::cell_of(double distance, std::uint32_t count) const {
  return static_cast<std::uint32_t>(std::clamp(distance * cells_per_mm_, 0.0,
                                               static_cast<double>(count - 1)));
}

template <typename Visit>
void FacingCells::visit_cells(const LayerEdge& edge, const Visit& visit) const {
  const Vec2 end = edge.to();
  const Vec2 lower = (edge.from.y <= end.y ? edge.from : end) - low_;
  const Vec2 upper = (edge.from.y <= end.y ? end : edge.from) - low_;
  const std::uint32_t first_row = cell_of(lower.y - margin_, rows_);
  const std::uint32_t last_row = cell_of(upper.y + margin_, rows_);
  const bool is_short = last_row - first_row < 2;
  const double slope =
      upper.y > lower.y ? (upper.x - lower.x) / (upper.y - lower.y) : 0;
  for (std::uint32_t row = first_row; row <= last_row; ++row) {
    double x0 = lower.x;
    double x1 = upper.x;
    if (!is_short) {
      // The part of the edge that comes near to this row.
      const double bottom = row / cells_per_mm_ - margin_;
      const double top = (row + 1) / cells_per_mm_ + margin_;
      x0 += slope * (std::clamp(bottom, lower.y, upper.y) - lower.y);
      x1 = lower.x + slope * (std::clamp(top, lower.y, upper.y) - lower.y);
    }
    const std::uint32_t last_column =
        cell_of(std::max(x0, x1) + margin_, columns_);
    for (std::uint32_t column = cell_of(std::min(x0, x1) - margin_, columns_);
         column <= last_column; ++column) {
      visit(std::size_t{row} * columns_ + column);
    }
  }
}

void FacingCells::mark_directions() {
  directions_.assign(std::size_t{columns_} * rows_, 0);
  edge_directions_.resize(edges_.size());
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const std::uint64_t sectors =
        directions_of(edges_[edges_[i].previous], edges_[i]);
    edge_directions_[i] = sectors;
    visit_cells(edges_[i],
                [&](std::size_t cell) { directions_[cell] |= sectors; });
  }
  for (std::uint64_t& sectors : directions_) {
    if ((sectors & facing(sectors)) == 0) sectors = 0;
    has_facing_ |= sectors != 0;
  }
}

// Sorts by counting: sizes first, then places.
void FacingCells::list_members() {
  starts_.assign(directions_.size() + 1, 0);
  const auto visit_kept = [&](const auto& visit) {
    for (std::uint32_t i = 0; i < edges_.size(); ++i) {
      visit_cells(edges_[i], [&](std::size_t cell) {
        if (directions_[cell] != 0) visit(cell, i);
      });
    }
  };
  visit_kept([&](std::size_t cell, std::uint32_t) { ++starts_[cell]; });
  std::uint32_t sum = 0;
  for (std::uint32_t& start : starts_) start = sum += start;
  members_.resize(sum);
  visit_kept([&](std::size_t cell, std::uint32_t edge) {
    members_[--starts_[cell]] = edge;
  });
}

void FacingCells::gather(std::uint32_t edge,
                         std::vector<std::uint32_t>& neighbours) {
  neighbours.clear();
  ++gather_;
  const std::uint64_t wanted = facing(edge_directions_[edge]);
  visit_cells(edges_[edge], [&](std::size_t cell) {
    if ((directions_[cell] & wanted) == 0) return;
    for (std::uint32_t i = starts_[cell]; i < starts_[cell + 1]; ++i) {
      const std::uint32_t member = members_[i];
      if (last_gather_[member] == gather_) continue;
      last_gather_[member] = gather_;
      neighbours.push_back(member);
    }
  });
}

std::span<const std::uint32_t> FacingCells::near(Vec2 centre) const {
  const std::size_t cell =
      std::size_t{cell_of(centre.y - low_.y, rows_)} * columns_ +
      cell_of(centre.x - low_.x, columns_);
  return {members_.data() + starts_[cell], starts_[cell + 1] - starts_[cell]};
}

}  // namespace lamina::slicer
