#pragma once
// Which leaves made the places of a layer's contours.
//
// Contours do not say which leaf a point comes from: the moving ray has no use
// for it, and few places are asked for. So the layer's chains are searched for
// one that passes through the place. The places are in a grid, where every
// segment of a chain looks up those beside it.

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "plane/chains.h"
#include "plane/point_grid.h"

namespace lamina::slicer {

class LeafSearch {
 public:
  // Returns the instance of each place, kNoInstance where no chain passes;
  // where surfaces of leaves coincide, that of the first leaf. The result is
  // valid until the next call.
  std::span<const std::uint32_t> find(const plane::ChainBlock& block,
                                      std::uint32_t layer,
                                      std::span<const Vec2> places);

 private:
  void look_between_endpoints(std::uint32_t instance);
  void look_along(Vec2 from, Vec2 to, std::uint32_t instance);

  std::span<const Vec2> places_;
  std::vector<std::uint32_t> members_;
  PointGrid grid_;
  std::vector<double> distances_;         // of the nearest chain to a place
  std::vector<std::uint32_t> instances_;  // of that chain
  std::vector<Vec2> endpoints_;           // of the chains of one instance
};

}  // namespace lamina::slicer
