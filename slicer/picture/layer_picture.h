#pragma once
// A picture of one layer: its measures, a scale, its thin places.

#include <cstddef>
#include <string>
#include <vector>

#include "slicer/contour/layer.h"
#include "slicer/picture/image.h"

namespace lamina::slicer {

struct LayerPictureOptions {
  unsigned width = 1200;   // of the picture [pixels]
  double min_feature = 0;  // what is thinner is marked [mm]; 0: nothing
};

// index  of the layer drawn; the picture shows its own bounds, or those of all
//        layers where it is empty
// title  shown at the top
Image draw_layer_picture(const std::vector<Layer>& layers, std::size_t index,
                         const std::string& title,
                         const LayerPictureOptions& options);

}  // namespace lamina::slicer
