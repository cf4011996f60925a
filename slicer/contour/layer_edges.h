#pragma once
// The edges of a layer.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "plane/contours.h"
#include "plane/predicates.h"

namespace lamina::slicer {

// The solid lies to the left of every edge.
struct LayerEdge {
  Vec2 from;
  Vec2 along;         // unit vector
  double length = 0;  // [mm], > 0
  std::uint32_t previous = 0;
  std::uint32_t next = 0;
  std::uint32_t loop = 0;

  Vec2 to() const { return from + length * along; }
};

// Calls visit(from, to) for every edge, loop by loop.
template <typename Visit>
void visit_edges(const plane::Contours& contours, const Visit& visit) {
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    const std::span<const Vec2> loop = contours.loop(i);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      visit(loop[k], loop[k + 1 < loop.size() ? k + 1 : 0]);
    }
  }
}

// Replaces `edges` by those of all loops, loop by loop. Points that repeat
// their predecessor give none.
void collect_edges(const plane::Contours& contours,
                   std::vector<LayerEdge>& edges);

}  // namespace lamina::slicer
