#include "ldni/kinetic_ray.h"

#include <cstddef>
#include <memory>
#include <utility>

#include "ldni/detail/chain_builder.h"
#include "ldni/detail/ray_sweep.h"
#include "ldni/sample.h"

namespace lamina::ldni {
namespace {

// Points nearer than this [mm] are one where near ties were resolved: what is
// left of faces apart by less than a tie is that small. Else they are one
// where a column can have moved them, kColumnWidth.
constexpr double kResolvedMergeDistance = 1e-8;

// Sweeps the loops of a layer once more, as one leaf that may overlap itself:
// solid is where they wind around in the positive sense, and only what differs
// by rounding ties.
class Resolver {
 public:
  void resolve(Contours& contours) {
    block_.layer_count = 1;
    builder_.begin(block_);
    for (std::size_t i = 0; i < contours.loop_count(); ++i) {
      const auto loop = contours.loop(i);
      builder_.loop().assign(loop.begin(), loop.end());
      builder_.close_loop(0, 0, 1);
    }
    builder_.finish(block_);
    sweep_.sweep(block_, 0, contours);
  }

 private:
  static csg::Scene one_leaf() {
    csg::Scene scene;
    scene.leaves.resize(1);
    scene.leaves[0].may_overlap_itself = true;
    scene.instances.resize(1);
    scene.program.push_back({csg::BooleanOp::kUnion, 0, false, 1});
    return scene;
  }

  const csg::Scene scene_ = one_leaf();
  detail::RaySweep sweep_{scene_,
                          {0, kColumnWidth, kResolvedMergeDistance,
                           detail::LeafSets::Rule::kPositive}};
  detail::ChainBuilder builder_;
  ChainBlock block_;
};

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
  Resolver resolver;
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
