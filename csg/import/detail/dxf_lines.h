#pragma once
// Joins lines whose ends stand on a grid.

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/vec.h"
#include "csg/import/dxf.h"

namespace lamina::csg {

// The points of the grid where lines end, by number.
class DxfGrid {
 public:
  // The point that stands for `point`: that of its cell of the grid, or else of
  // the nearest of the eight cells around it; a new one where none has any.
  //
  // point  no farther than kGreatestCoordinate from the origin
  std::uint32_t snap(Vec2 point);

  Vec2 operator[](std::uint32_t i) const { return points_[i]; }
  std::size_t size() const { return points_.size(); }

 private:
  using Cell = std::pair<std::int64_t, std::int64_t>;
  struct Hash {
    std::size_t operator()(const Cell& cell) const {
      const auto x = static_cast<std::uint64_t>(cell.first);
      const auto y = static_cast<std::uint64_t>(cell.second);
      return ((x << 32 | x >> 32) ^ y) * 0x9e3779b97f4a7c15u >> 7;
    }
  };

  std::unordered_map<Cell, std::uint32_t, Hash> cells_;
  std::vector<Vec2> points_;
};

using DxfLine = std::array<std::uint32_t, 2>;  // points of the grid

// Joins lines to paths as OpenSCAD does: first paths that begin at an open end,
// then the others; where several lines could go on, the first of the file does.
// Cost: n log n.
std::vector<DxfPath> join_lines(const std::vector<DxfLine>& lines,
                                const DxfGrid& grid);

}  // namespace lamina::csg
