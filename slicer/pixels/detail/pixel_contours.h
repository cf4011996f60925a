#pragma once
// Contours of an image of a layer: where the grey is half.
//
// Between the middles of pixels the grey is taken for even (marching squares,
// as Lorensen and Cline 1987 have them in space). On straight edges that is
// true to a tenth of a pixel.

#include <cstddef>
#include <cstdint>
#include <span>

#include "plane/contours.h"

namespace lamina::slicer {

// pixels   columns × rows of grey, from the top
// returns  loops in pixels, x to the right and y downwards, the middle of the
//          first pixel at (0.5, 0.5); the white to the left as seen with y
//          upwards
plane::Contours trace_pixels(std::span<const std::uint8_t> pixels,
                             std::size_t columns, std::size_t rows);

}  // namespace lamina::slicer
