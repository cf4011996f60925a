#pragma once
// Which leaves made the sides of a thin place.
//
// Contours do not say which leaf a point comes from: the moving ray has no use
// for it, and thin places are few. So the layer's chains are searched for one
// that passes through the place. The places stand in a grid, where every
// segment of a chain looks up those beside it.

#include <cstdint>
#include <span>
#include <vector>

#include "base/point_grid.h"
#include "base/vec.h"
#include "ldni/section/leaf_section.h"
#include "slicer/check/thin_finder.h"

namespace lamina::slicer {

// One object per thread: it owns the scratch that layers share.
class LeafSearch {
 public:
  // Sets the instances of stretches of layer `layer` of the block. Of leaves
  // whose surfaces coincide it takes the first.
  void find(const ldni::ChainBlock& block, std::uint32_t layer,
            std::span<ThinStretch> stretches);

 private:
  void look_between_endpoints(std::uint32_t instance);
  void look_along(Vec2 from, Vec2 to, std::uint32_t instance);

  std::vector<Vec2> places_;  // two for each stretch
  std::vector<std::uint32_t> members_;
  PointGrid grid_;
  std::vector<double> distances_;         // of the nearest chain to a place
  std::vector<std::uint32_t> instances_;  // of that chain
  std::vector<Vec2> endpoints_;  // of the chains of the instance in hand
};

}  // namespace lamina::slicer
