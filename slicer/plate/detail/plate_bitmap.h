#pragma once
// The cells of a plate that are taken, 64 in a word.
//
// A shape is tried in a column from the bottom up. Where a run of it meets a
// run of the plate, every place at which the two still meet is skipped.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "slicer/plate/detail/cell_shape.h"

namespace lamina::slicer {

struct CellPlace {
  std::int32_t column = 0;
  std::int32_t row = 0;
  bool operator==(const CellPlace&) const = default;
};

class PlateBitmap {
 public:
  PlateBitmap(std::int32_t columns, std::int32_t rows);

  // The first free place in order of columns, from `first` on, then of rows, no
  // farther than `last` in either; the shape fits into the bitmap at all of
  // these.
  std::optional<CellPlace> find_place(const CellShape& shape,
                                      std::int32_t first_column,
                                      CellPlace last) const;
  void add(const CellShape& shape, CellPlace place);

 private:
  // Where the run [begin, end) of that column meets taken cells: the first cell
  // above them that is free; else -1.
  std::int32_t blocked_until(std::int32_t column, std::int32_t begin,
                             std::int32_t end) const;
  // The next row to try where a column of the shape meets taken cells; else -1.
  std::int32_t next_row(const CellShape& shape, std::int32_t i,
                        CellPlace place) const;

  std::size_t words_per_column_;
  std::vector<std::uint64_t> words_;
};

}  // namespace lamina::slicer
