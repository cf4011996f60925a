#pragma once
// A layer as the grey PNG image that a printer's panel shows.

#include <string>

#include "ldni/section/contours.h"
#include "slicer/formats/coverage.h"
#include "slicer/formats/panel.h"

namespace lamina::slicer {

// The layer as a PNG file of width × height pixels: each the share of it that
// is covered, 255 for all.
//
// Costs what the box around the contours does; the rest of the panel next to
// nothing (run_deflater.h).
std::string draw_grey_png(const ldni::Contours& contours, unsigned width,
                          unsigned height, const PixelMap& map,
                          PixelLayout layout = PixelLayout::kGrey);

}  // namespace lamina::slicer
