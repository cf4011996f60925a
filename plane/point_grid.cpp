#include "plane/point_grid.h"

#include <algorithm>
#include <utility>

namespace lamina {
namespace {

// More points than these make a cell crowded. Where points lie evenly, no cell
// has so many.
constexpr std::size_t kCrowd = 32;

constexpr double kCellsPerPoint = 2;
constexpr double kLeastCell = 1e-12;  // where all points are one [mm]

}  // namespace

void PointGrid::fill(std::span<const Vec2> points,
                     std::span<const std::uint32_t> members) {
  levels_.clear();
  if (!members.empty()) add_level(points, members);
}

void PointGrid::Level::list_members(std::span<const Vec2> points,
                                    std::span<const std::uint32_t> all) {
  members.fill(grid.size(), [&](const auto& list) {
    for (const std::uint32_t i : all) {
      const std::size_t cell = grid.cell_of(points[i]);
      if (!std::ranges::binary_search(crowded_cells, cell)) list(cell, i);
    }
  });
}

// Returns the level's place.
std::uint32_t PointGrid::add_level(std::span<const Vec2> points,
                                   std::span<const std::uint32_t> members) {
  const auto place = static_cast<std::uint32_t>(levels_.size());
  levels_.emplace_back();
  Level level;
  for (const std::uint32_t i : members) level.box.add(points[i]);
  level.grid = {kCellsPerPoint * static_cast<double>(members.size()), level.box,
                kLeastCell};
  level.list_members(points, members);
  // Points that all fall in one cell are in one place, and no grid parts them.
  for (std::size_t cell = 0; cell < level.grid.size(); ++cell) {
    const std::size_t count = level.members[cell].size();
    if (count <= kCrowd || count == members.size()) continue;
    level.crowded_cells.push_back(cell);
    level.their_levels.push_back(add_level(points, level.members[cell]));
  }
  if (!level.crowded_cells.empty()) level.list_members(points, members);
  levels_[place] = std::move(level);
  return place;
}

}  // namespace lamina
