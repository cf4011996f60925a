#pragma once
// What the readers of images for panels have in common.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "plane/contours.h"
#include "slicer/contour/layer_file.h"
#include "slicer/machine/printer.h"

namespace lamina::slicer {

// Panels have some 10⁸ pixels; a file that says more is broken.
inline constexpr std::size_t kMostPixels = 1'000'000'000;

// Returns the contours of what the panel shows, where the grey is half, in the
// design's directions [mm]; the middle of the panel is at x = y = 0. They are
// simplified within their own accuracy.
//
// pixels  rows of grey from the top, as many as the printer has
plane::Contours contours_on_panel(std::span<const std::uint8_t> pixels,
                                  const Printer& printer);

// format  its name, for people
LayerFileFacts panel_file_facts(const std::string& format, std::size_t images,
                                const Printer& printer,
                                const std::string& writer);

}  // namespace lamina::slicer
