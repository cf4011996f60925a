#pragma once
// One layer under the moving ray: from chains to contours.
//
// An event point gathers its event cluster, all that lies within 1e-9 mm, and
// is handled in this order:
//
//   1. take                 ended chains leave the status, begun ones enter it,
//                           and lone loops are passed over;
//   2. RayOrder::settle     new neighbours are put in the order right of the
//                           cluster, which may bring up failures inside it:
//                           again until there are none;
//   3. RayBoundary::update  states from the changes upwards, then the boundary,
//                           where the solid differs below and above: arcs end
//                           and begin, and what ended and began is linked.
//
// The order knows chains and where they cross, and no solid. The boundary knows
// what a crossing means, by a machine of states (program_states.h), and no
// event. They share the status and meet in OrderChanges.
//
// What follows from what, and where it is kept:
//
// I1  Every leaf has an even number of entries between two clusters. Chains
//     come from closed loops (one threshold decides above and below for both
//     faces of an edge), and the ends of a vertical edge have one x exactly.
//     Else the state above the topmost entry is not kOutside: counted as an
//     unbalanced cluster.
// I2  The state above an entry follows from the state below it and the entry's
//     crossing; above the topmost entry it is kOutside. update_states_from.
// I3  Between clusters neighbours are apart or tied, so the order is constant,
//     so every 1D Boolean there has the same result: one ray proves the slab.
//     settle, and the certificates in the event queue.
// I4  In every cluster as many heads as tails of arcs end or begin: they bound
//     the difference of the solid intervals left and right. The region is the
//     union of the trapezoids between clusters, and contours close whatever the
//     rounding. An end without a partner is counted as a repaired cluster.
// I5  Every point is a vertex of a leaf's section, a point on an edge of it at
//     an event point, or a crossing of two such edges. end_arc, start_arc.
// I6  Progress: a failure lies strictly right of the cluster in which it was
//     found. Swaps in a cluster are capped, and the cap is counted.
//
// Assertions check all of them in debug builds. The counts are kept in all
// builds, reported by `--report` and warned of.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "plane/chains.h"
#include "plane/contours.h"
#include "plane/order/ray_order.h"
#include "plane/program/program_states.h"
#include "plane/sweep/chain_endpoints.h"
#include "plane/sweep/lone_loops.h"
#include "plane/sweep/ray_boundary.h"
#include "plane/sweep/sweep_options.h"

namespace lamina::plane {

// Swaps of neighbours that a sweep bears: so many for each chain met so far,
// and some at the beginning. Long walks along the ray, as among thousands of
// faces that coincide, count as swaps: so many steps as one.
struct Patience {
  double swaps_per_chain = kNever;
  double first_swaps = 0;
};
inline constexpr double kStepsPerSwap = 4;

class RaySweep {
 public:
  explicit RaySweep(const SweepOptions& options)
      : pitch_(options.pitch),
        order_(options.tie_distance),
        boundary_(order_.status(), options) {}
  RaySweep(const RaySweep&) = delete;
  RaySweep& operator=(const RaySweep&) = delete;

  // Stands before a layer, whose chains are those of the operands of `states`.
  // Both must outlive its sweep.
  void begin(const LayerChains& layer, ProgramStates& states);

  // Replaces `contours` by the loops of the layer. Gives up where neighbours
  // have swapped more often than `patience` bears: false, and `contours` is as
  // before; the next call, with more patience, goes on from there.
  bool resume(Contours& contours, const Patience& patience);

  // Handles the next event point of the layer; false where there is none. A
  // look into a sweep takes it so, instead of resume() (sweep_trace.h).
  bool step();
  const Status& status() const { return order_.status(); }
  // The event point handled last.
  const EventCluster& cluster() const { return order_.cluster(); }

  // As of RayBoundary, for the last layer.
  bool has_jumps() const { return boundary_.has_jumps(); }

  // Counts slabs, event points, and what must not happen, over all sweeps since
  // construction.
  SweepCounts counts() const;

  // Counts the layer as far as it was swept.
  double swaps_per_chain() const { return swaps() / chains_met(); }

 private:
  std::uint32_t slab_count(double width, std::size_t point_count) const;
  void begin_cluster(double x);
  void finish_cluster();
  // Counts the swaps of the layer, and what its walks cost.
  double swaps() const {
    return static_cast<double>(order_.swaps()) +
           static_cast<double>(order_.status().long_walks()) / kStepsPerSwap;
  }
  // Chains that began, and half of them end too.
  double chains_met() const { return static_cast<double>(next_endpoint_) / 2; }
  std::span<const ChainEndpoint> next_endpoints();
  void pass_lone_loop(std::uint32_t chain);
  void take(std::span<const ChainEndpoint> endpoints);
  void insert(std::uint32_t chain);
  std::span<const Vec2> points_of(std::uint32_t chain) const {
    return chains_[chain].points_in(points_);
  }

  const double pitch_;
  ProgramStates* states_ = nullptr;
  SweepCounts counts_;
  RayOrder order_;
  RayBoundary boundary_;
  LoneLoops lone_loops_;
  EndpointSorter sorter_;

  // The present layer.
  std::span<const Vec2> points_;
  std::span<const Chain> chains_;
  std::span<const ChainEndpoint> endpoints_;
  std::size_t next_endpoint_ = 0;
  // The present cluster; where a sweep was given up within it, it goes on.
  bool is_in_cluster_ = false;
  std::vector<std::uint32_t> begun_;  // chains
  std::size_t next_begun_ = 0;
};

}  // namespace lamina::plane
