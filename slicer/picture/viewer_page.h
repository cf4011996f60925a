#pragma once
// All layers as one page for a browser: a file that needs no network and no
// other file.
//
// The page is a template (slicer/picture/viewer_template.h) with the part
// (slicer/picture/viewer_part.h), its contours deflated and in base64: every
// browser since 2023 inflates them by itself.

#include <string>
#include <vector>

#include "slicer/contour/layer.h"
#include "slicer/picture/viewer_part.h"

namespace lamina::slicer {

// layers  ascending; at least one of them with a contour
std::string viewer_page(const std::vector<Layer>& layers,
                        const ViewerOptions& options);

}  // namespace lamina::slicer
