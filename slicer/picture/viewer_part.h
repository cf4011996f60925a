#pragma once
// Layers as a page in a browser reads them (slicer/picture/viewer/part.js): the
// measures and findings that `lamina inspect` shows, as JSON, and the contours
// as a stream of integers: steps from one corner to the next, in zigzag form
// and 7 bits a byte. That is some 3 bytes a corner once it is deflated.
//
// Of a print with supports the page gets the part and the supports by
// themselves, too. Nearly all loops of a layer are loops of one of both: a
// number for each says of which, and only where part and supports touch their
// own loops follow. What has a color of its own comes in the same way.

#include <optional>
#include <string>
#include <vector>

#include "base/vec.h"
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
  // Coordinates are multiples of this [mm], or of its tenfold, hundredfold, …
  // where the part is larger than 2^30 of them.
  double step = 1e-4;
};

struct ViewerPart {
  std::string facts;     // JSON
  std::string contours;  // bytes
};

// layers  ascending; at least one of them with a contour
ViewerPart viewer_part(const std::vector<Layer>& layers,
                       const ViewerOptions& options);

struct ViewerLayer {
  // JSON: z, bottom, top, loops, holes, vertices, area, perimeter.
  std::string row;
  std::string contours;  // bytes: the loops, from the lower corner of the whole
  double step;           // of their coordinates [mm]
};

// One layer by itself.
//
// whole  of all layers: that of the part, so that both have their origin in
//        common
// step   as in ViewerOptions
ViewerLayer viewer_layer(const Layer& layer, const Box2& whole, double step);

}  // namespace lamina::slicer
