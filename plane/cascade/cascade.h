#pragma once
// Cascaded sweeps: a Boolean where many solids overlap, group by group.
//
// A union of n leaves that overlap k deep has n·k crossings on the ray, though
// its boundary has few. So where a sweep meets many crossings it is given up;
// the operands are parted into two groups that lie together, each group is
// swept to contours by itself, in the same way, and the contours are the two
// operands of one more sweep. What is hidden within a group is gone before the
// groups meet, and the cost falls from n·k towards n·log n.
//
// Differences in each other, A - (B - (C - ...)), are parted level by level.
// Where a place is in the first k levels and not in the next one, it is in the
// result if k is odd. So a run of levels is two contours, the result and what
// lies in all of the levels, and two runs make one (decision 69).
//
// Where leaves reach far beyond the places where they can matter, they are
// clipped first (chain_clipper.h): crossings there are hidden as well. Leaves
// that lie within others are left out (covered_leaves.h). A layer that has few
// other crossings is swept at once.
//
// Whether a sweep is given up or clipped depends on the layer alone, so
// contours do not depend on threads; layers with few crossings are swept as
// ever. The contours of a group are regular, so they toggle. Their points are
// vertices of leaves, or crossings rounded once (2e-12 mm at 1e4 mm), far below
// a tie, so faces that coincide still tie when their groups meet. I5
// (ray_sweep.h) holds for edges whose ends are such points.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "plane/cascade/chain_clipper.h"
#include "plane/cascade/covered_leaves.h"
#include "plane/chain_builder.h"
#include "plane/chains.h"
#include "plane/contours.h"
#include "plane/program/boolean_program.h"
#include "plane/program/program_states.h"
#include "plane/sweep/loop_resolver.h"
#include "plane/sweep/ray_sweep.h"
#include "plane/sweep/sweep_options.h"

namespace lamina::plane {

class Cascade {
 public:
  // The program must outlive the object.
  //
  // patience  the swaps that are borne before a sweep is given up, in units of
  //           the usual number. At 0 all that crosses is cascaded.
  Cascade(const BooleanProgram& program, const SweepOptions& options,
          double patience = 1);
  ~Cascade();

  // Replaces `contours` by the loops of a layer, whose chains are those of the
  // program's operands.
  void sweep(const LayerChains& layer, Contours& contours);

  SweepCounts counts() const;

 private:
  class Group;
  struct Chains;
  struct Levels;
  struct Run;

  void clip_and_sweep(const LayerChains& layer, Contours& contours);
  void uncover_and_sweep(const LayerChains& layer, Contours& contours);
  void sweep(Group& group, const LayerChains& layer, double expected_swaps,
             Contours& contours);
  double expected_swaps(const LayerChains& layer) const;
  Patience patience_for(Group& group, const LayerChains& layer) const;
  void sweep_halves(Group& group, const LayerChains& layer,
                    double expected_swaps, Contours& contours);
  void sweep_half(Group& half, const LayerChains& layer, double expected_swaps,
                  Contours& contours);
  bool sweep_at_once(ProgramStates& states, const LayerChains& layer,
                     Contours& contours, const Patience& patience);
  bool resume(Contours& contours, const Patience& patience);
  void sweep_levels(Levels& levels, const LayerChains& layer,
                    Contours& contours);
  Run sweep_run(Levels& levels, std::span<const Vec2> points,
                std::span<const Chains> chains, std::size_t begin,
                bool needs_all);
  // Replaces `contours` by an operator over them and `second`.
  void merge(BooleanOp op, const Contours& second, Contours& contours);

  const SweepOptions options_;
  const double patience_;
  RaySweep ray_;
  std::optional<LoopResolver> resolver_;  // made when it is needed
  std::unique_ptr<Group> root_;
  const bool clips_;  // where a sweep is given up
  ChainClipper clipper_;
  CoveredLeaves covered_;
  // An operator over two contours each; made when they are needed.
  std::array<std::optional<ProgramStates>, 3> merges_;
  ChainBuilder builder_;
  ChainBlock block_;  // of two contours
  SweepCounts counts_;
  bool is_resolved_ = false;  // the present layer, or a group of it
};

}  // namespace lamina::plane
