#pragma once
// PNG files: layers as the grey images that a printer's panel shows, and
// previews in colour.

#include <cstdint>
#include <span>
#include <string>

#include "plane/contours.h"
#include "slicer/machine/printer.h"
#include "slicer/pixels/coverage.h"

namespace lamina::slicer {

// Returns the layer as a PNG file of width × height pixels: the grey of each is
// the share of it that the layer covers, 255 for all.
//
// Cost: that of the box around the contours; the rest of the panel takes next
// to no time (run_deflater.h).
std::string draw_grey_png(const plane::Contours& contours, unsigned width,
                          unsigned height, const PixelMap& map,
                          PixelLayout layout = PixelLayout::kGrey);

// pixels  rows from the top, of red, green and blue
std::string encode_rgb_png(unsigned width, unsigned height,
                           std::span<const std::uint8_t> pixels);

}  // namespace lamina::slicer
