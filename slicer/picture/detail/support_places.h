#pragma once
// Which places of a stack's layers are supports', for pictures that show them
// in a colour of their own.
//
// Layers of a design with supports have contours of the part and of the
// supports alone. What is on or in the part is the part's, tips in it too; of
// anything else, what is nearer to the supports is theirs. So a place may lie
// beside both by a little, as on the contours of the whole, which were
// simplified by themselves.

#include <cstddef>
#include <vector>

#include "base/vec.h"
#include "slicer/contour/layer.h"
#include "slicer/picture/detail/layer_distance.h"

namespace lamina::slicer {

class SupportPlaces {
 public:
  // Costs nothing for layers without supports.
  explicit SupportPlaces(const std::vector<Layer>& layers);

  // Whether a place on or in a layer is a support's.
  bool hold(std::size_t layer, Vec2 place) const;

 private:
  struct Depths {
    LayerDistance part;
    LayerDistance supports;
  };

  std::vector<Depths> depths_;
  std::vector<std::size_t> depths_of_;  // of each layer; 0: it has no supports
};

}  // namespace lamina::slicer
