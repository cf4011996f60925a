#include "ldni/sweep/kinetic_ray.h"

#include <memory>

#include "csg/tie_distance.h"
#include "ldni/sweep/detail/ray_sweep.h"
#include "ldni/sweep/loop_resolver.h"

namespace lamina::ldni {
namespace {

// Points nearer than this [mm] are one where near ties were resolved: what is
// left of faces apart by less than a tie is that small. Else they are one
// where a column can have moved them, kColumnWidth.
constexpr double kResolvedMergeDistance = 1e-8;

}  // namespace

struct KineticRay::State {
  State(const csg::Scene& scene, double pitch)
      : sweep(scene, {pitch, kTieDistance, kColumnWidth,
                      detail::LeafSets::Rule::kNonZero}) {}

  detail::RaySweep sweep;
  // What differs by rounding only ties.
  LoopResolver resolver{kColumnWidth, kResolvedMergeDistance};
};

KineticRay::KineticRay(const csg::Scene& scene, double pitch)
    : state_(std::make_unique<State>(scene, pitch)) {}

KineticRay::~KineticRay() = default;

void KineticRay::sweep(const ChainBlock& block, std::uint32_t layer,
                       Contours& contours) {
  detail::RaySweep& sweep = state_->sweep;
  sweep.sweep(block, layer, contours);
  if (!sweep.has_jumps()) return;
  state_->resolver.resolve(contours);
  ++sweep.counts().resolved_layers;
}

SweepCounts KineticRay::counts() const {
  SweepCounts counts = state_->sweep.counts();
  // Of layers swept once more only what went wrong is told.
  const SweepCounts& resolved = state_->resolver.counts();
  counts.unbalanced_columns += resolved.unbalanced_columns;
  counts.repaired_columns += resolved.repaired_columns;
  counts.capped_columns += resolved.capped_columns;
  return counts;
}

}  // namespace lamina::ldni
