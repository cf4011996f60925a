#pragma once
// Joins lines whose ends stand on a grid.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "csg/import/dxf.h"
#include "csg/mesh/vertex_table.h"

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
  VertexTable cells_;         // in steps of the grid; numbered as the points
  std::vector<Vec2> points_;  // [mm]
};

using DxfLine = std::array<std::uint32_t, 2>;  // points of the grid

// Joins lines to paths as OpenSCAD does: first paths that begin at an open end,
// then the others; where several lines could go on, the first of the file does.
// Cost: n log n.
std::vector<DxfPath> join_lines(const std::vector<DxfLine>& lines,
                                const DxfGrid& grid);

}  // namespace lamina::csg
