#pragma once
// The no-fit polygon of two regions as a table: for each displacement of a
// lattice, whether they overlap and how deep.
//
// B overlaps A where it is moved by a displacement in the sum of A and the
// mirrored B. The sum is the union of the sums of convex parts, and a union of
// samples needs no Booleans. A displacement of the lattice is judged exactly,
// however coarse the lattice is: no outline is made larger than it is.
//
// The depth is the distance to the nearest displacement without overlap, so
// narrow places and holes where B fits are found like others. Source: Borgefors
// 1986, distance transforms; the steps are those of the 3-4 chamfer.
//
// The lattice is stored as sixteen coarser ones, so that looking at every
// fourth place of the plate reads successive numbers.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "plane/region/region.h"
#include "slicer/plate/detail/plate_bitmap.h"

namespace lamina::slicer {

// Where a number stands in an array of columns of so many rows.
inline std::size_t column_index(std::int32_t column, std::int32_t rows,
                                std::int32_t row) {
  return static_cast<std::size_t>(column) * static_cast<std::size_t>(rows) +
         static_cast<std::size_t>(row);
}

// Every fourth place in each direction, and what is added up at each.
struct CoarseGrid {
  CellPlace first;
  std::int32_t columns = 0;
  std::int32_t rows = 0;
  std::vector<std::uint16_t> sums;  // columns × rows, column by column
};

class NoFitTable {
 public:
  static constexpr std::int32_t kStride = 4;
  // A step of the lattice, in units of depth.
  static constexpr std::uint8_t kStep = 3;

  // a, b  convex parts, counter-clockwise
  // step  of the lattice [mm]
  NoFitTable(std::span<const plane::Contour> a,
             std::span<const plane::Contour> b, double step);

  // That of b and a.
  NoFitTable reversed() const;

  // 0 where b, moved by so many steps, does not overlap a; else how deep it
  // does, at most 255.
  std::uint8_t depth(std::int32_t column, std::int32_t row) const {
    const auto u = static_cast<std::uint32_t>(column - low_.column);
    const auto v = static_cast<std::uint32_t>(row - low_.row);
    const auto c = static_cast<std::uint32_t>(columns_);
    const auto r = static_cast<std::uint32_t>(rows_);
    if (u / kStride >= c || v / kStride >= r) return 0;
    const std::uint32_t plane = u % kStride * kStride + v % kStride;
    return depths_[(plane * c + u / kStride) * r + v / kStride];
  }

  // Adds `weight`, up to 256, times the depth at each place of the grid, as far
  // as a sum can grow. a lies at `at`.
  void add_to(CoarseGrid& grid, CellPlace at, std::uint16_t weight) const;

  // Displacements from `low` on, before `high`, may overlap.
  CellPlace low() const { return low_; }
  CellPlace high() const {
    return {low_.column + columns_ * kStride, low_.row + rows_ * kStride};
  }
  std::size_t size() const { return depths_.size(); }
  // Of one of the coarser lattices.
  std::size_t coarse_size() const { return size() / kStride / kStride; }

 private:
  // Of the displacement `low` + (u, v).
  std::uint8_t& at(std::int32_t u, std::int32_t v);

  CellPlace low_;
  std::int32_t columns_ = 0;  // of each coarser lattice
  std::int32_t rows_ = 0;
  std::vector<std::uint8_t> depths_;
};

}  // namespace lamina::slicer
