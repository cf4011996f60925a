#include "slicer/picture/image.h"

#include <algorithm>
#include <cmath>

#include <png.h>

#include "base/diagnostic.h"

namespace lamina::slicer {
namespace {

// Fast and small enough: pictures are mostly flat.
constexpr int kCompressionLevel = 6;

void append_bytes(png_structp png, png_bytep bytes, png_size_t count) {
  auto& file = *static_cast<std::string*>(png_get_io_ptr(png));
  file.append(reinterpret_cast<const char*>(bytes), count);
}

void keep_bytes(png_structp /*png*/) {}  // there is nothing to flush

// libpng would use longjmp; an exception passes through its C frames as well,
// since Debian builds it with unwind tables.
[[noreturn]] void throw_png_error(png_structp /*png*/, png_const_charp words) {
  throw FileError(std::string("PNG: ") + words);
}

std::uint8_t to_byte(float value) {
  return static_cast<std::uint8_t>(
      std::lround(255 * std::clamp(value, 0.0F, 1.0F)));
}

// Frees libpng's memory also when writing throws.
struct PngWriter {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr,
                                            &throw_png_error, nullptr);
  png_infop info = png_create_info_struct(png);

  PngWriter() = default;
  ~PngWriter() { png_destroy_write_struct(&png, &info); }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;
};

}  // namespace

std::string png_of(const Image& image) {
  std::string file;
  PngWriter writer;
  png_set_write_fn(writer.png, &file, &append_bytes, &keep_bytes);
  png_set_compression_level(writer.png, kCompressionLevel);
  png_set_IHDR(writer.png, writer.info, image.width, image.height, 8,
               PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(writer.png, writer.info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(writer.png, writer.info);
  std::vector<std::uint8_t> row(std::size_t{3} * image.width);
  for (unsigned y = 0; y < image.height; ++y) {
    for (unsigned x = 0; x < image.width; ++x) {
      for (std::size_t channel = 0; channel < 3; ++channel) {
        row[std::size_t{3} * x + channel] = to_byte(image.at(x, y)[channel]);
      }
    }
    png_write_row(writer.png, row.data());
  }
  png_write_end(writer.png, writer.info);
  return file;
}

void write_png(const Image& image, OutputFile& output) {
  output.write(png_of(image));
}

}  // namespace lamina::slicer
