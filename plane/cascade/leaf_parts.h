#pragma once
// What a layer has of each leaf.

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "plane/chains.h"

namespace lamina::plane {

// The loops of one leaf in a layer, one after another.
struct LeafPart {
  std::uint32_t operand = 0;
  std::span<const Chain> chains;
  std::span<const ChainLoop> loops;
  Box2 box;
};

// The parts of all leaves of the layer, which must outlive them.
std::vector<LeafPart> leaf_parts(const LayerChains& layer);

Box2 box_of(std::span<const Chain> chains, std::span<const Vec2> points);

}  // namespace lamina::plane
