// Images of heights.

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/file/png_image.h"
#include "csg/import/surface_file.h"
#include "csg/limits.h"

namespace lamina::csg {

HeightField parse_png(std::string_view bytes, bool invert, Language rules) {
  const PngImage image =
      read_png_image(bytes, PngChannels::kRgba, require_heights);
  HeightField field;
  field.columns = image.columns;
  field.rows = image.rows;
  field.heights.resize(image.columns * image.rows);
  constexpr double kAboveAll = 200;  // mm
  if (rules != Language::k2021) field.bottom = kAboveAll;
  for (std::size_t row = 0; row < image.rows; ++row) {
    const std::uint8_t* pixel = &image.pixels[4 * row * image.columns];
    double* height = &field.heights[(image.rows - 1 - row) * image.columns];
    for (std::size_t i = 0; i < image.columns; ++i, pixel += 4, ++height) {
      const double luminance =
          0.2126 * pixel[0] + 0.7152 * pixel[1] + 0.0722 * pixel[2];
      *height = 100.0 / 255 * (invert ? 1 - luminance : luminance);
      field.bottom = std::min(field.bottom, *height - 1);
    }
  }
  return field;
}

}  // namespace lamina::csg
