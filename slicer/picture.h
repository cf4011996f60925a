#pragma once
// Pictures of layers, for people: a contact sheet of single layers, or all
// layers stacked to the solid that they make.

#include <string>
#include <vector>

#include "slicer/image.h"
#include "slicer/layer.h"

namespace lamina::slicer {

enum class PictureStyle { kSheet, kStack };

struct PictureOptions {
  PictureStyle style = PictureStyle::kSheet;
  unsigned width = 1600;      // of the picture [pixels]
  unsigned layer_count = 20;  // on a contact sheet; filled up to whole rows
};

// layers  ascending; at least one of them with a contour
// title   shown at the top
Image draw_picture(const std::vector<Layer>& layers, const std::string& title,
                   const PictureOptions& options);

}  // namespace lamina::slicer
