#include "slicer/grey_png.h"

#include <algorithm>
#include <cmath>

#include "slicer/image.h"

namespace lamina::slicer {
namespace {

// Rows [begin, end) that the contours reach.
struct Rows {
  unsigned begin = 0;
  unsigned end = 0;
};

Rows rows_of(const ldni::Contours& contours, unsigned height,
             const PixelMap& map) {
  double low = height;
  double high = 0;
  for (const Vec2& point : contours.points) {
    const double y = map(point).y;
    low = std::min(low, y);
    high = std::max(high, y);
  }
  if (high <= low) return {};
  return {
      static_cast<unsigned>(std::clamp<double>(low, 0, height)),
      static_cast<unsigned>(std::clamp<double>(std::ceil(high), 0, height))};
}

}  // namespace

std::string draw_grey_png(const ldni::Contours& contours, unsigned width,
                          unsigned height, const PixelMap& map) {
  const Rows rows = rows_of(contours, height, map);
  Coverage coverage(width, rows.end - rows.begin);
  PixelMap shifted = map;
  shifted.origin.y -= rows.begin;
  add_contours(coverage, contours, shifted);
  std::vector<float> shares;
  return grey_png(width, height, [&](unsigned y, std::uint8_t* row) {
    std::fill(row, row + width, std::uint8_t{0});
    if (y < rows.begin || y >= rows.end) return;
    coverage.resolve_row(y - rows.begin, shares);
    std::transform(shares.begin(), shares.end(), row, [](float share) {
      return static_cast<std::uint8_t>(255 * share + 0.5F);
    });
  });
}

}  // namespace lamina::slicer
