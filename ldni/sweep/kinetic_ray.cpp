#include "ldni/sweep/kinetic_ray.h"

#include <memory>

#include "csg/tie_distance.h"
#include "ldni/sweep/detail/program_states.h"
#include "ldni/sweep/detail/ray_sweep.h"
#include "ldni/sweep/loop_resolver.h"

namespace lamina::ldni {
namespace {

// Points nearer than this [mm] are one where near ties were resolved: what is
// left of faces apart by less than a tie is that small. Elsewhere points are
// one where an event cluster can have moved them, kClusterWidth.
constexpr double kResolvedMergeDistance = 1e-8;

}  // namespace

struct KineticRay::State {
  State(const csg::Scene& scene, double pitch)
      : states(scene, detail::ProgramStates::Rule::kNonZero),
        sweep(states, {pitch, kTieDistance, kClusterWidth}) {}

  detail::ProgramStates states;
  detail::RaySweep sweep;
  // What differs by rounding only ties.
  LoopResolver resolver{kClusterWidth, kResolvedMergeDistance};
  std::uint64_t resolved_layers = 0;
};

KineticRay::KineticRay(const csg::Scene& scene, double pitch)
    : state_(std::make_unique<State>(scene, pitch)) {}

KineticRay::~KineticRay() = default;

void KineticRay::sweep(const ChainBlock& block, std::uint32_t layer,
                       Contours& contours) {
  state_->sweep.sweep(block, layer, contours);
  if (!state_->sweep.has_jumps()) return;
  state_->resolver.resolve(contours);
  ++state_->resolved_layers;
}

SweepCounts KineticRay::counts() const {
  SweepCounts counts = state_->sweep.counts();
  counts.resolved_layers = state_->resolved_layers;
  // Of the second sweeps only what went wrong counts.
  const SweepCounts resolved = state_->resolver.counts();
  counts.unbalanced_clusters += resolved.unbalanced_clusters;
  counts.repaired_clusters += resolved.repaired_clusters;
  counts.capped_clusters += resolved.capped_clusters;
  return counts;
}

}  // namespace lamina::ldni
