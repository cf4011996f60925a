#pragma once
// The gaps between neighbours on the moving ray, from end to end.
//
// The ray's order (plane/order/ray_order.h) says which chains are neighbours.
// Two of them bound a gap from the x where they become neighbours to the x
// where another chain comes between them, one of them ends, or they cross. So
// gaps cut the plane into parts between two chains. Each part lies in one face
// of each of two sets of contours, and these follow upwards: the faces above a
// chain are those below it, but for the set that the chain belongs to.
//
// RayBoundary draws what a Boolean leaves of the same order. Here nothing is
// drawn: whoever lays two sets over each other looks at the gaps one by one,
// for areas (plane/sweep/region_areas.h) or for what overlaps
// (slicer/check/layer_overlay.h).

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/vec.h"
#include "plane/chains.h"
#include "plane/order/chain_cursor.h"
#include "plane/order/ray_order.h"
#include "plane/sweep/chain_endpoints.h"

namespace lamina::plane {

// The face of each set, a number that only the visitor understands. Below all
// chains both are 0.
using Faces = std::array<std::uint32_t, 2>;

struct Gap {
  std::uint32_t lower = kNone;  // chains of the layer
  std::uint32_t upper = kNone;
  double begin = 0;  // x
  double end = 0;
  Faces faces{};
  ChainCursor lower_at;  // on the segments that hold `begin`
  ChainCursor upper_at;
};

class GapVisitor {
 public:
  virtual ~GapVisitor() = default;
  // Returns the faces above a chain, given those below it.
  virtual Faces above(std::uint32_t chain, Faces below) = 0;
  // A gap has ended. Chains that tie have none between them.
  virtual void take(const Gap& gap) = 0;
};

class GapSweep {
 public:
  // tie_distance  chains nearer than this from vertex to vertex are one [mm]
  explicit GapSweep(double tie_distance) : order_(tie_distance) {}

  // Shows all gaps of a layer, in the order of their ends.
  void sweep(const LayerChains& layer, GapVisitor& visitor);

  // Swaps of neighbours in the layer so far.
  std::uint64_t swaps() const { return order_.swaps(); }

 private:
  void take_endpoints();
  void renew_gaps();
  bool renew_gap(std::uint32_t entry);
  void close(Gap& gap, double end);
  std::span<const Vec2> points_of(std::uint32_t chain) const {
    return layer_.chains[chain].points_in(layer_.points);
  }

  RayOrder order_;
  EndpointSorter sorter_;
  // The present layer.
  LayerChains layer_;
  GapVisitor* visitor_ = nullptr;
  std::span<const ChainEndpoint> endpoints_;
  std::size_t next_endpoint_ = 0;
  std::vector<Gap> gaps_;  // above each entry; without an upper chain: none
  std::vector<std::uint32_t> begun_;                        // chains
  std::vector<std::pair<double, std::uint32_t>> doubtful_;  // entries by y
};

// Calls visit(lower, upper, left, right, width, next) for the parts of a gap
// between successive vertices of either chain, from left to right, until it
// returns false. `width` and `next` say how far apart the chains are on the
// left and on the right.
template <typename Visit>
void visit_parts(const Gap& gap, const Visit& visit) {
  ChainCursor lower = gap.lower_at;
  ChainCursor upper = gap.upper_at;
  double left = gap.begin;
  double width = upper.y_at(left) - lower.y_at(left);
  for (;;) {
    const double right = std::min({lower.right_x(), upper.right_x(), gap.end});
    const double next = upper.y_at(right) - lower.y_at(right);
    if (!visit(lower, upper, left, right, width, next)) return;
    if (right >= gap.end) return;
    for (ChainCursor* const chain : {&lower, &upper}) {
      if (chain->right_x() != right) continue;
      // Rounding may put the end of the gap behind that of a chain.
      if (chain->is_last_segment()) return;
      chain->step();
    }
    left = right;
    width = next;
  }
}

}  // namespace lamina::plane
