#pragma once
// Pictures out of PNG files.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

namespace lamina {

enum class PngChannels {
  kRgba,    // red, green, blue and alpha, whatever the file holds
  kStored,  // grey, or red, green and blue, as the file holds them
};

struct PngImage {
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::size_t channels = 0;
  // rows × columns × channels, from the top; 8 bits each.
  std::vector<std::uint8_t> pixels;
};

// Throws where an image of that size is too large for its purpose.
using CheckPngSize = std::function<void(std::size_t columns, std::size_t rows)>;

// check_size  is called before memory is taken
// throws      FormatError for a malformed image; what check_size throws
PngImage read_png_image(std::string_view bytes, PngChannels channels,
                        const CheckPngSize& check_size);

}  // namespace lamina
