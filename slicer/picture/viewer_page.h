#pragma once
// All layers as one page for a browser: a file that needs no network and no
// other file.
//
// The page is a template (slicer/picture/viewer) with two things put in: the
// measures and findings that `lamina inspect` shows, as JSON, and the contours
// as a stream of integers: steps from one corner to the next in units of 1e-4
// mm, in zigzag form and 7 bits a byte; deflated and in base64. That is some 3
// bytes a corner, and every browser since 2023 inflates it by itself.
//
// Of a print with supports the page gets the part and the supports by
// themselves, too. Nearly all loops of a layer are loops of one of both: a
// number for each says of which, and only where part and supports touch their
// own loops follow. What has a color of its own comes in the same way.

#include <optional>
#include <string>
#include <vector>

#include "slicer/check/print/layer_graph.h"
#include "slicer/check/thin/thin_features.h"
#include "slicer/contour/layer.h"

namespace lamina::slicer {

struct ViewerOptions {
  std::string title;       // the part's name
  std::string estimate;    // what the print takes, in words; may be empty
  double min_feature = 0;  // marks walls and gaps that are thinner [mm]
  // Thin features that were found before, and what made each. Without them,
  // thin features are searched for in the layers.
  std::vector<ThinFeature> features;
  std::vector<std::string> source_lines;
  // What the layer graph found, and what made each finding. No value where
  // nobody looked; no text where that is not known.
  std::optional<PrintCheck> print;
  std::vector<std::string> finding_source_lines;
  std::string supports;  // how much they are, in words; may be empty
};

// layers  ascending; at least one of them with a contour
std::string viewer_page(const std::vector<Layer>& layers,
                        const ViewerOptions& options);

}  // namespace lamina::slicer
