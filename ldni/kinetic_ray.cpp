#include "ldni/kinetic_ray.h"

#include <memory>
#include <utility>

#include "ldni/detail/ray_sweep.h"
#include "ldni/loop_resolver.h"
#include "ldni/sample.h"

namespace lamina::ldni {
namespace {

// Points nearer than this [mm] are one where near ties were resolved: what is
// left of faces apart by less than a tie is that small. Else they are one
// where a column can have moved them, kColumnWidth.
constexpr double kResolvedMergeDistance = 1e-8;

}  // namespace

SweepCounts& SweepCounts::operator+=(const SweepCounts& other) {
  layers += other.layers;
  chains += other.chains;
  points += other.points;
  slabs += other.slabs;
  stops += other.stops;
  evaluations += other.evaluations;
  resolved_layers += other.resolved_layers;
  capped_columns += other.capped_columns;
  repaired_columns += other.repaired_columns;
  return *this;
}

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

const SweepCounts& KineticRay::counts() const {
  return std::as_const(state_->sweep).counts();
}

}  // namespace lamina::ldni
