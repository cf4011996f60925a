#pragma once
// A layer on a printer's panel, as runs of equally covered pixels.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/common.hpp>

#include "plane/contours.h"
#include "slicer/pixels/coverage.h"

namespace lamina::slicer {

// The part of the panel that contours can cover [pixels].
struct PixelBox {
  unsigned left;
  unsigned right;
  unsigned first_row;
  unsigned end_row;
};

inline PixelBox box_of(const plane::Contours& contours, unsigned width,
                       unsigned height, const PixelMap& map) {
  const Vec2 size(width, height);
  Vec2 low = size;
  Vec2 high(0);
  for (const Vec2& point : contours.points) {
    low = glm::min(low, map(point));
    high = glm::max(high, map(point));
  }
  low = glm::clamp(glm::floor(low), Vec2(0), size);
  high = glm::max(low, glm::clamp(glm::ceil(high), Vec2(0), size));
  return {static_cast<unsigned>(low.x), static_cast<unsigned>(high.x),
          static_cast<unsigned>(low.y), static_cast<unsigned>(high.y)};
}

// The rows of each loop [pixels]: the least and the greatest y.
inline std::vector<Vec2> rows_of_loops(const plane::Contours& contours,
                                       const PixelMap& map) {
  std::vector<Vec2> rows(contours.loop_count());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i] = {std::numeric_limits<double>::infinity(),
               -std::numeric_limits<double>::infinity()};
    for (const Vec2& point : contours.loop(i)) {
      const double y = map(point).y;
      rows[i] = {std::min(rows[i].x, y), std::max(rows[i].y, y)};
    }
  }
  return rows;
}

// Calls visit(grey, count) for all pixels, row by row from the top; runs go on
// from one row to the next, and a grey may come in several runs.
//
// lead  this many pixels of grey 0 come before each row
template <typename Visit>
void visit_runs(const plane::Contours& contours, unsigned width,
                unsigned height, const PixelMap& map, unsigned lead,
                const Visit& visit) {
  // Rows are drawn in bands of about this many pixels, so that memory stays
  // small however large the panel.
  constexpr unsigned kBandPixels = 1 << 18;
  const auto [left, right, first_row, end_row] =
      box_of(contours, width, height, map);
  const unsigned band = std::max(1U, kBandPixels / std::max(1U, right - left));
  const std::uint64_t row_size = std::uint64_t{lead} + width;
  visit(0, first_row * row_size);
  const std::vector<Vec2> rows = rows_of_loops(contours, map);
  Coverage coverage(right - left, std::min(band, end_row - first_row));
  std::vector<GreyRun> runs;
  for (unsigned top = first_row; top < end_row; top += band) {
    const unsigned end = std::min(end_row, top + band);
    PixelMap shifted = map;
    shifted.origin -= Vec2(left, top);
    // A loop that is not in the band, by more than rounding, adds nothing.
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].y < top - 1.0 || rows[i].x > end + 1.0) continue;
      add_loop(coverage, contours.loop(i), shifted);
    }
    for (unsigned y = 0; y < end - top; ++y) {
      visit(0, std::uint64_t{lead} + left);
      coverage.resolve_row(y, runs);
      for (const GreyRun& run : runs) visit(run.grey, run.count);
      visit(0, width - right);
    }
    coverage.clear();
  }
  visit(0, (height - end_row) * row_size);
}

}  // namespace lamina::slicer
