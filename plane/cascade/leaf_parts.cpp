#include "plane/cascade/leaf_parts.h"

#include <cstddef>

#include "base/lanes.h"

namespace lamina::plane {

std::vector<LeafPart> leaf_parts(const LayerChains& layer) {
  std::vector<LeafPart> parts;
  std::size_t chain = 0;
  std::size_t loop = 0;
  while (loop < layer.loops.size()) {
    const std::size_t first_chain = chain;
    const std::size_t first_loop = loop;
    LeafPart& part = parts.emplace_back();
    part.operand = layer.chains[chain].operand;
    while (loop < layer.loops.size() &&
           layer.chains[chain].operand == part.operand) {
      chain += layer.loops[loop++].chain_count;
    }
    part.chains = layer.chains.subspan(first_chain, chain - first_chain);
    part.loops = layer.loops.subspan(first_loop, loop - first_loop);
    part.box = box_of(part.chains, layer.points);
  }
  return parts;
}

Box2 box_of(std::span<const Chain> chains, std::span<const Vec2> points) {
  Box2 box;
  Lanes low = lanes_of(box.low);
  Lanes high = lanes_of(box.high);
  for (const Chain& chain : chains) {
    for (const Vec2& point : chain.points_in(points)) {
      low = least(low, lanes_of(point));
      high = greatest(high, lanes_of(point));
    }
  }
  return {point_of(low), point_of(high)};
}

}  // namespace lamina::plane
