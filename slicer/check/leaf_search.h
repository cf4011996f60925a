#pragma once
// Which leaves made the sides of a thin place.
//
// Contours do not say what leaf a point comes from: the moving ray has no use
// for it, and thin places are few. So the chains of the layer are asked: the
// one that passes through the place tells. The places stand in a grid, and
// every segment of a chain looks up those beside it.

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "ldni/section/leaf_section.h"
#include "slicer/check/thin_finder.h"
#include "slicer/contour/point_grid.h"

namespace lamina::slicer {

// One object per thread: it owns the scratch that layers share.
class LeafSearch {
 public:
  // Sets the instances of stretches of layer `layer` of the block. Where the
  // surfaces of several leaves coincide, the first one is told.
  void find(const ldni::ChainBlock& block, std::uint32_t layer,
            std::span<ThinStretch> stretches);

 private:
  void look_between_turns(std::uint32_t instance);
  void look_along(Vec2 from, Vec2 to, std::uint32_t instance);

  std::vector<Vec2> places_;  // two a stretch
  std::vector<std::uint32_t> members_;
  PointGrid grid_;
  std::vector<double> distances_;         // of the nearest chain to a place
  std::vector<std::uint32_t> instances_;  // of that chain
  std::vector<Vec2> turns_;               // of the instance in hand
};

}  // namespace lamina::slicer
