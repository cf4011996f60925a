#include "slicer/formats/detail/grey_png.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include <zlib.h>

#include "slicer/formats/detail/run_deflater.h"

namespace lamina::slicer {
namespace {

// Pixels [begin, end) along a side of the panel.
struct PixelSpan {
  double low;  // of contours, in pixels
  double high;
  unsigned size;  // of the side

  void add(double place) {
    low = std::min(low, place);
    high = std::max(high, place);
  }
  unsigned begin() const { return clamped(std::floor(low)); }
  unsigned end() const { return std::max(begin(), clamped(std::ceil(high))); }

 private:
  unsigned clamped(double place) const {
    return static_cast<unsigned>(std::clamp<double>(place, 0, size));
  }
};

// The part of the panel that contours can cover.
struct PixelBox {
  PixelSpan columns;
  PixelSpan rows;
};

PixelBox box_of(const ldni::Contours& contours, unsigned width, unsigned height,
                const PixelMap& map) {
  PixelBox box = {{1.0 * width, 0, width}, {1.0 * height, 0, height}};
  for (const Vec2& point : contours.points) {
    const Vec2 place = map(point);
    box.columns.add(place.x);
    box.rows.add(place.y);
  }
  return box;
}

// Rows are drawn in bands of about this many pixels, so that memory stays
// small however large the panel.
constexpr unsigned kBandPixels = 1 << 18;

// Packs the rows of the panel, each behind the 0 that says that it is not
// filtered.
std::string pack_rows(const ldni::Contours& contours, unsigned width,
                      unsigned height, const PixelMap& map) {
  const PixelBox box = box_of(contours, width, height, map);
  const unsigned left = box.columns.begin();
  const unsigned right = box.columns.end();
  const unsigned bottom = box.rows.end();
  const unsigned band = std::max(1U, kBandPixels / std::max(1U, right - left));
  RunDeflater packed;
  const std::uint64_t row_size = std::uint64_t{1} + width;
  packed.add(0, box.rows.begin() * row_size);
  std::vector<GreyRun> runs;
  for (unsigned top = box.rows.begin(); top < bottom; top += band) {
    Coverage coverage(right - left, std::min(band, bottom - top));
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
  packed.add(0, (height - bottom) * row_size);
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
