#pragma once
// An image in memory, and how it becomes a PNG file.

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "base/file/output_file.h"

namespace lamina::slicer {

using Rgb = std::array<float, 3>;  // 0 … 1, as the screen shows them (sRGB)

// rows × columns, row-major, y down.
struct Image {
  unsigned width = 0;
  unsigned height = 0;
  std::vector<Rgb> pixels;

  Image(unsigned w, unsigned h, Rgb background)
      : width(w), height(h), pixels(std::size_t{w} * h, background) {}

  Rgb& at(unsigned x, unsigned y) { return pixels[std::size_t{y} * width + x]; }
  const Rgb& at(unsigned x, unsigned y) const {
    return pixels[std::size_t{y} * width + x];
  }
};

// The bytes of a PNG file of it, 8 bits a channel. Throws FileError.
std::string png_of(const Image& image);

// Appends the image as a PNG file. Throws FileError.
void write_png(const Image& image, OutputFile& output);

}  // namespace lamina::slicer
