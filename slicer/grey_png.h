#pragma once
// A layer as the grey PNG image that a printer's panel shows.

#include <cstdint>
#include <string>
#include <vector>

#include "ldni/contours.h"
#include "slicer/coverage.h"

namespace lamina::slicer {

// The layer as a PNG file of 8-bit grey: each pixel the share of it that is
// covered, 255 for all.
//
// Rows that nothing covers cost next to nothing.
std::string draw_grey_png(const ldni::Contours& contours, unsigned width,
                          unsigned height, const PixelMap& map);

}  // namespace lamina::slicer
