#include "slicer/pixels/png_encoder.h"

#include <cstdint>
#include <new>
#include <string_view>

#include <zlib.h>

#include "slicer/pixels/detail/run_deflater.h"
#include "slicer/pixels/grey_runs.h"

namespace lamina::slicer {
namespace {

// Packs the rows of the panel, each behind the 0 that says that it is not
// filtered.
std::string pack_rows(const plane::Contours& contours, unsigned width,
                      unsigned height, const PixelMap& map) {
  RunDeflater packed;
  visit_runs(
      contours, width, height, map, 1,
      [&](std::uint8_t grey, std::uint64_t count) { packed.add(grey, count); });
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

enum class Channels { kGrey, kRgb };

// packed  rows as a zlib stream
std::string png_of(unsigned width, unsigned height, Channels channels,
                   std::string_view packed) {
  std::string header;
  append_number(header, width);
  append_number(header, height);
  header += '\x08';  // bits
  header += channels == Channels::kGrey ? '\0' : '\x02';
  header += std::string_view("\0\0\0", 3);  // deflate, filters, no interlace
  std::string png = "\x89PNG\r\n\x1a\n";
  append_chunk(png, "IHDR", header);
  append_chunk(png, "IDAT", packed);
  append_chunk(png, "IEND", {});
  return png;
}

}  // namespace

std::string draw_grey_png(const plane::Contours& contours, unsigned width,
                          unsigned height, const PixelMap& map,
                          PixelLayout layout) {
  const bool is_grey = layout == PixelLayout::kGrey;
  return png_of(is_grey ? width : width / 3, height,
                is_grey ? Channels::kGrey : Channels::kRgb,
                pack_rows(contours, width, height, map));
}

std::string encode_rgb_png(unsigned width, unsigned height,
                           std::span<const std::uint8_t> pixels) {
  const std::size_t row_size = std::size_t{3} * width;
  std::string rows;
  for (std::size_t y = 0; y < height; ++y) {
    rows += '\0';  // not filtered
    const auto row = pixels.subspan(y * row_size, row_size);
    rows.append(row.begin(), row.end());
  }
  uLongf size = compressBound(static_cast<uLong>(rows.size()));
  std::string packed(size, '\0');
  if (compress(reinterpret_cast<Bytef*>(packed.data()), &size,
               reinterpret_cast<const Bytef*>(rows.data()),
               static_cast<uLong>(rows.size())) != Z_OK) {
    throw std::bad_alloc();
  }
  packed.resize(size);
  return png_of(width, height, Channels::kRgb, packed);
}

}  // namespace lamina::slicer
