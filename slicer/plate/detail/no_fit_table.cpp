#include "slicer/plate/detail/no_fit_table.h"

#include <algorithm>
#include <cmath>

#include "plane/region/minkowski.h"
#include "plane/region/region.h"
#include "plane/tie_distance.h"

namespace lamina::slicer {
namespace {

constexpr std::uint8_t kDeepest = 255;
constexpr std::uint8_t kDiagonalStep = 4;

// Half a turn keeps the direction of a contour.
std::vector<plane::Contour> mirrored(std::span<const plane::Contour> parts) {
  std::vector<plane::Contour> turned(parts.begin(), parts.end());
  for (plane::Contour& part : turned) {
    for (Vec2& p : part) p = -p;
  }
  return turned;
}

// Places of a lattice, column by column, with free ones all around.
class Samples {
 public:
  Samples(CellPlace low, std::int32_t columns, std::int32_t rows)
      : low_(low),
        columns_(columns),
        rows_(rows),
        depths_(static_cast<std::size_t>(columns) *
                static_cast<std::size_t>(rows)),
        lower_(static_cast<std::size_t>(columns)),
        upper_(static_cast<std::size_t>(columns)) {}

  // Marks what is inside of a convex polygon, in steps of the lattice, deeper
  // than a tie.
  void mark(const plane::Contour& polygon, double tie) {
    Box2 box;
    box.add(polygon);
    const auto first = static_cast<std::int32_t>(std::ceil(box.low.x + tie));
    const auto last = static_cast<std::int32_t>(std::floor(box.high.x - tie));
    if (first > last) return;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 from = polygon[i];
      const Vec2 to = polygon[i + 1 == polygon.size() ? 0 : i + 1];
      if (to.x > from.x) note(from, to, first, last, lower_);
      if (to.x < from.x) note(to, from, first, last, upper_);
    }
    for (std::int32_t x = first; x <= last; ++x) {
      const std::size_t column = static_cast<std::size_t>(x - low_.column);
      const auto begin =
          static_cast<std::int32_t>(std::ceil(lower_[column] + tie));
      const auto end =
          static_cast<std::int32_t>(std::floor(upper_[column] - tie)) + 1;
      if (begin >= end) continue;
      std::uint8_t* depths = &depths_[index(x - low_.column, 0)] - low_.row;
      std::fill(depths + begin, depths + end, kDeepest);
    }
  }

  // Replaces marks by distances from what is not marked.
  void measure() {
    const std::ptrdiff_t up = 1;
    const std::ptrdiff_t right = rows_;
    for (std::int32_t i = 1; i + 1 < columns_; ++i) {
      for (std::int32_t k = 1; k + 1 < rows_; ++k) {
        lower(i, k, -up, -right, up - right, -up - right);
      }
    }
    for (std::int32_t i = columns_ - 2; i > 0; --i) {
      for (std::int32_t k = rows_ - 2; k > 0; --k) {
        lower(i, k, up, right, up + right, right - up);
      }
    }
  }

  const std::vector<std::uint8_t>& depths() const { return depths_; }

 private:
  std::size_t index(std::int32_t i, std::int32_t k) const {
    return column_index(i, rows_, k);
  }

  // Notes where an edge passes columns of the lattice.
  void note(Vec2 left, Vec2 right, std::int32_t first, std::int32_t last,
            std::vector<double>& heights) const {
    const double slope = (right.y - left.y) / (right.x - left.x);
    first = std::max(first, static_cast<std::int32_t>(std::ceil(left.x)));
    last = std::min(last, static_cast<std::int32_t>(std::floor(right.x)));
    for (std::int32_t x = first; x <= last; ++x) {
      heights[static_cast<std::size_t>(x - low_.column)] =
          left.y + slope * (x - left.x);
    }
  }

  void lower(std::int32_t i, std::int32_t k, std::ptrdiff_t straight,
             std::ptrdiff_t other_straight, std::ptrdiff_t diagonal,
             std::ptrdiff_t other_diagonal) {
    std::uint8_t* here = &depths_[index(i, k)];
    if (*here == 0) return;
    const int nearest = std::min(
        std::min(here[straight], here[other_straight]) + NoFitTable::kStep,
        std::min(here[diagonal], here[other_diagonal]) + kDiagonalStep);
    *here = static_cast<std::uint8_t>(std::min<int>(*here, nearest));
  }

  CellPlace low_;
  std::int32_t columns_;
  std::int32_t rows_;
  std::vector<std::uint8_t> depths_;
  std::vector<double> lower_;  // border of a polygon, by column
  std::vector<double> upper_;
};

}  // namespace

NoFitTable::NoFitTable(std::span<const plane::Contour> a,
                       std::span<const plane::Contour> b, double step) {
  if (a.empty() || b.empty()) return;
  const std::vector<plane::Contour> turned = mirrored(b);
  const Box2 a_box = plane::box_of(a);
  const Box2 b_box = plane::box_of(turned);
  const Vec2 low = glm::floor((a_box.low + b_box.low) / step) - 1.0;
  const Vec2 high = glm::ceil((a_box.high + b_box.high) / step) + 1.0;
  low_ = {static_cast<std::int32_t>(low.x), static_cast<std::int32_t>(low.y)};
  const auto count = [](double length) {
    return (static_cast<std::int32_t>(length) + kStride) / kStride;
  };
  columns_ = count(high.x - low.x);
  rows_ = count(high.y - low.y);
  Samples samples(low_, columns_ * kStride, rows_ * kStride);
  for (const plane::Contour& one : a) {
    for (const plane::Contour& other : turned) {
      plane::Contour sum = plane::add_convex(one, other);
      for (Vec2& p : sum) p /= step;
      samples.mark(sum, kTieDistance / step);
    }
  }
  samples.measure();
  depths_.resize(samples.depths().size());
  for (std::int32_t u = 0; u < columns_ * kStride; ++u) {
    for (std::int32_t v = 0; v < rows_ * kStride; ++v) {
      at(u, v) = samples.depths()[column_index(u, rows_ * kStride, v)];
    }
  }
}

std::uint8_t& NoFitTable::at(std::int32_t u, std::int32_t v) {
  const std::int32_t plane = u % kStride * kStride + v % kStride;
  return depths_[column_index(plane * columns_ + u / kStride, rows_,
                              v / kStride)];
}

NoFitTable NoFitTable::reversed() const {
  NoFitTable other = *this;
  // The last displacement becomes the first one. Planes, columns and rows all
  // turn around, and so does the array.
  other.low_ = {1 - high().column, 1 - high().row};
  std::reverse(other.depths_.begin(), other.depths_.end());
  return other;
}

void NoFitTable::add_to(CoarseGrid& grid, CellPlace at,
                        std::uint16_t weight) const {
  const auto divide = [](std::int32_t number) {
    return (number - (number & (kStride - 1))) / kStride;
  };
  const std::int32_t u = grid.first.column - at.column - low_.column;
  const std::int32_t v = grid.first.row - at.row - low_.row;
  const std::int32_t plane =
      (u & (kStride - 1)) * kStride + (v & (kStride - 1));
  // Grid columns i meet table columns u0 + i.
  const std::int32_t u0 = divide(u);
  const std::int32_t v0 = divide(v);
  const std::int32_t first_row = std::max(0, -v0);
  const std::int32_t end_row = std::min(grid.rows, rows_ - v0);
  if (first_row >= end_row) return;
  const auto count = static_cast<std::size_t>(end_row - first_row);
  const std::int32_t end_column = std::min(grid.columns, columns_ - u0);
  for (std::int32_t i = std::max(0, -u0); i < end_column; ++i) {
    std::uint16_t* sums = &grid.sums[column_index(i, grid.rows, first_row)];
    const std::uint8_t* depths = &depths_[column_index(
        plane * columns_ + u0 + i, rows_, v0 + first_row)];
    for (std::size_t k = 0; k < count; ++k) {
      const auto price = static_cast<std::uint16_t>(weight * depths[k]);
      const auto room = static_cast<std::uint16_t>(~sums[k]);
      sums[k] = static_cast<std::uint16_t>(sums[k] + std::min(price, room));
    }
  }
}

}  // namespace lamina::slicer
