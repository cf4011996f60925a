#pragma once
// A PNG file as libpng's simple reader sees it.

#include <array>
#include <string>
#include <vector>

#include <png.h>

namespace lamina::cli {

struct Picture {
  unsigned width = 0;
  unsigned height = 0;
  std::vector<unsigned char> rgb;

  std::array<int, 3> at(unsigned x, unsigned y) const {
    const std::size_t i = 3 * (std::size_t{y} * width + x);
    return {rgb[i], rgb[i + 1], rgb[i + 2]};
  }
};

// Empty where there is no such file.
inline Picture read_png(const std::string& path) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  Picture picture;
  if (png_image_begin_read_from_file(&image, path.c_str()) == 0) return {};
  image.format = PNG_FORMAT_RGB;
  picture.rgb.resize(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, picture.rgb.data(), 0, nullptr) ==
      0) {
    return {};
  }
  picture.width = image.width;
  picture.height = image.height;
  return picture;
}

}  // namespace lamina::cli
