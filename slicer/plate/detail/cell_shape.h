#pragma once
// A region as cells of a grid: column by column the runs of cells that it
// covers, wholly or in part.
//
// What the region has in common with a column of cells is either on the line
// through the column's middle or, moved horizontally, meets an edge before that
// line. So the stretches of the line inside the region and the stretches of the
// edges within the column cover it all.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "plane/region/region.h"

namespace lamina::slicer {

// Cells [begin, end) of a column, upwards.
struct CellRun {
  std::int32_t begin;
  std::int32_t end;
};

class CellShape {
 public:
  CellShape() = default;
  // Cells that the region enters by less than a tie do not count.
  //
  // origin  the lower left corner of the first cell of the first column; no
  //         point of the region is left of it or below
  // cell    their side [mm]
  CellShape(const plane::Region& region, Vec2 origin, double cell);

  std::int32_t column_count() const {
    return static_cast<std::int32_t>(ends_.size());
  }
  // Disjoint, from the bottom to the top.
  std::span<const CellRun> column(std::int32_t i) const {
    const auto at = static_cast<std::size_t>(i);
    const std::size_t begin = at == 0 ? 0 : ends_[at - 1];
    return {runs_.data() + begin, ends_[at] - begin};
  }
  std::size_t cell_count() const;

 private:
  std::vector<CellRun> runs_;
  std::vector<std::size_t> ends_;  // of each column, in runs_
};

}  // namespace lamina::slicer
