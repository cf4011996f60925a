#pragma once
// All layers of a part stacked up and lit: the solid that the printer makes.
//
// No surface is reconstructed. The layers are drawn from the top down into a
// picture of heights, seen from above at an angle; a pixel belongs to the
// highest layer that covers it, which is the one a viewer sees, for a line of
// sight that goes down meets the highest one first. A layer is drawn at every
// height that is a pixel apart, so that it shows its side. A row remembers
// where its next free pixel is, so each pixel is written once, however many
// layers lie under it.
//
// Light needs a normal: the slope of the heights around a pixel, fitted to
// those neighbours that belong to the same surface.

#include <vector>

#include "slicer/image.h"
#include "slicer/layer.h"

namespace lamina::slicer {

// layers  ascending; at least one of them with a contour
// width   of the picture [pixels]
Image draw_relief(const std::vector<Layer>& layers, unsigned width);

}  // namespace lamina::slicer
