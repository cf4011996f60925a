#pragma once
// Points by place, for the question which of them lie near a segment.
//
// Points crowd: a part far from a plate of a hundred thousand rings leaves the
// plate in one cell of an even grid. So a cell with many points has a grid of
// its own, and so on; each level looks some hundred times closer, and numbers
// have no more than a few such levels.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "plane/cell_grid.h"

namespace lamina {

// Grids of about two cells a point, in each other.
class PointGrid {
 public:
  // Forgets what it held. `members` are indices into `points`.
  void fill(std::span<const Vec2> points,
            std::span<const std::uint32_t> members);

  // Calls is_hit(member) for all members within `reach` [mm] of the segment,
  // in x and in y, and for some beyond; returns true at the first that is one.
  template <typename IsHit>
  bool has_near(Vec2 a, Vec2 b, double reach, const IsHit& is_hit) const {
    return !levels_.empty() && has_near(levels_.front(), a, b, reach, is_hit);
  }

 private:
  // One grid. Points of a crowded cell are in the cell's own level and not in
  // the list of the cell.
  struct Level {
    Box2 box;
    CellGrid grid;
    CellLists<std::uint32_t> members;
    std::vector<std::size_t> crowded_cells;   // ascending
    std::vector<std::uint32_t> their_levels;  // in levels_

    // Lists the members that are not in crowded cells.
    void list_members(std::span<const Vec2> points,
                      std::span<const std::uint32_t> all);
  };

  std::uint32_t add_level(std::span<const Vec2> points,
                          std::span<const std::uint32_t> members);

  template <typename IsHit>
  bool has_near(const Level& level, Vec2 a, Vec2 b, double reach,
                const IsHit& is_hit) const;

  std::vector<Level> levels_;  // the whole first
};

template <typename IsHit>
bool PointGrid::has_near(const Level& level, Vec2 a, Vec2 b, double reach,
                         const IsHit& is_hit) const {
  const auto misses = [&](double low, double high, double from, double to) {
    return std::max(from, to) < low - reach ||
           std::min(from, to) > high + reach;
  };
  const auto& [low, high] = level.box;
  if (misses(low.x, high.x, a.x, b.x) || misses(low.y, high.y, a.y, b.y)) {
    return false;
  }
  return level.grid.visit_rows(
      a, b, Vec2(reach), [&](std::size_t first, std::size_t last) {
        for (const std::uint32_t member : level.members.between(first, last)) {
          if (is_hit(member)) return true;
        }
        const std::vector<std::size_t>& crowded = level.crowded_cells;
        auto cell = std::lower_bound(crowded.begin(), crowded.end(), first);
        for (; cell != crowded.end() && *cell <= last; ++cell) {
          const std::uint32_t inner =
              level.their_levels[static_cast<std::size_t>(cell -
                                                          crowded.begin())];
          if (has_near(levels_[inner], a, b, reach, is_hit)) return true;
        }
        return false;
      });
}

}  // namespace lamina
