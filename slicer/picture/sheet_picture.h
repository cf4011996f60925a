#pragma once
// A contact sheet: pictures of layers side by side, all to one scale.

#include <string>
#include <vector>

#include "slicer/contour/layer.h"
#include "slicer/picture/image.h"

namespace lamina::slicer {

struct SheetOptions {
  unsigned width = 1600;      // of the picture [pixels]
  unsigned layer_count = 20;  // filled up to whole rows
};

// layers  ascending; at least one of them with a contour
// title   shown at the top
Image draw_sheet(const std::vector<Layer>& layers, const std::string& title,
                 const SheetOptions& options);

}  // namespace lamina::slicer
