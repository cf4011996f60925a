#pragma once
// Which places of a stack's layers belong to supports or to what has a color,
// for pictures that show them in colors of their own.
//
// Layers have contours of these alone. What is on or in the part is the part's,
// tips of supports in it too; of anything else, what is nearer to the supports
// is theirs. Of what has a color, a place belongs to the one that it lies
// deepest in. So a place may lie beside both by a little, as on the contours of
// the whole, which were simplified by themselves.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/vec.h"
#include "slicer/contour/layer.h"
#include "slicer/picture/detail/layer_distance.h"

namespace lamina::slicer {

class BodyPlaces {
 public:
  // Costs nothing for layers that have neither.
  explicit BodyPlaces(const std::vector<Layer>& layers);

  // Whether a place on or in a layer is a support's.
  bool is_of_support(std::size_t layer, Vec2 place) const;

  // The color of a place on or in a layer, 0xRRGGBB, if it has one.
  std::optional<std::int32_t> color_at(std::size_t layer, Vec2 place) const;

 private:
  struct Depths {
    bool has_supports = false;
    LayerDistance part;
    LayerDistance supports;
    std::vector<std::pair<std::int32_t, LayerDistance>> colored;
  };

  std::vector<Depths> depths_;  // of each layer
};

}  // namespace lamina::slicer
