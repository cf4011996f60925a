#include "slicer/formats/detail/grey_png.h"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

#include <glm/common.hpp>
#include <zlib.h>

#include "slicer/formats/detail/run_deflater.h"

namespace lamina::slicer {
namespace {

// The part of the panel that contours can cover [pixels].
struct PixelBox {
  unsigned left;
  unsigned right;
  unsigned first_row;
  unsigned end_row;
};

PixelBox box_of(const ldni::Contours& contours, unsigned width, unsigned height,
                const PixelMap& map) {
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

// Rows are drawn in bands of about this many pixels, so that memory stays
// small however large the panel.
constexpr unsigned kBandPixels = 1 << 18;

// Packs the rows of the panel, each behind the 0 that says that it is not
// filtered.
std::string pack_rows(const ldni::Contours& contours, unsigned width,
                      unsigned height, const PixelMap& map) {
  const auto [left, right, first_row, end_row] =
      box_of(contours, width, height, map);
  const unsigned band = std::max(1U, kBandPixels / std::max(1U, right - left));
  RunDeflater packed;
  const std::uint64_t row_size = std::uint64_t{1} + width;
  packed.add(0, first_row * row_size);
  std::vector<GreyRun> runs;
  for (unsigned top = first_row; top < end_row; top += band) {
    Coverage coverage(right - left, std::min(band, end_row - top));
    PixelMap shifted = map;
    shifted.origin -= Vec2(left, top);
    add_contours(coverage, contours, shifted);
    for (unsigned y = 0; y < coverage.height(); ++y) {
      packed.add(0, 1 + left);
      coverage.resolve_row(y, runs);
      for (const GreyRun& run : runs) packed.add(run.grey, run.count);
      packed.add(0, width - right);
    }
  }
  packed.add(0, (height - end_row) * row_size);
  return packed.finish();
}

void append_number(std::string& bytes, std::uint64_t number) {
  for (int shift = 24; shift >= 0; shift -= 8) {
    bytes.push_back(static_cast<char>(number >> shift));
  }
}

void append_chunk(std::string& png, std::string_view kind,
                  std::string_view content) {
  append_number(png, content.size());
  const std::size_t begin = png.size();
  png.append(kind).append(content);
  append_number(png,
                crc32_z(0, reinterpret_cast<const Bytef*>(png.data()) + begin,
                        png.size() - begin));
}

}  // namespace

std::string draw_grey_png(const ldni::Contours& contours, unsigned width,
                          unsigned height, const PixelMap& map,
                          PixelLayout layout) {
  const bool is_grey = layout == PixelLayout::kGrey;
  std::string header;
  append_number(header, is_grey ? width : width / 3);
  append_number(header, height);
  header += '\x08';                         // bits
  header += is_grey ? '\0' : '\x02';        // grey or colour
  header += std::string_view("\0\0\0", 3);  // deflate, filters, no interlace
  std::string png = "\x89PNG\r\n\x1a\n";
  append_chunk(png, "IHDR", header);
  append_chunk(png, "IDAT", pack_rows(contours, width, height, map));
  append_chunk(png, "IEND", {});
  return png;
}

}  // namespace lamina::slicer
