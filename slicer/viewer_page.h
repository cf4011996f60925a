#pragma once
// All layers as one page for a browser: a file that needs no network and no
// other file.
//
// The page is a template (slicer/viewer) with two things put in. A JSON object
// tells what is known of the part and of each layer, so that the page shows the
// numbers of `lamina inspect`, not sums of its own. The contours are a stream
// of integers: steps from one corner to the next in units of 1e-4 mm, in zigzag
// form and 7 bits a byte, small numbers one byte; deflated and in base64. That
// is some 3 bytes a corner, and every browser since 2023 inflates it by itself.

#include <string>
#include <vector>

#include "slicer/layer.h"

namespace lamina::slicer {

// layers       ascending; at least one of them with a contour
// title        of the page: the part's name
// min_feature  marks walls and gaps that are thinner [mm]; 0: none
std::string viewer_page(const std::vector<Layer>& layers,
                        const std::string& title, double min_feature);

}  // namespace lamina::slicer
