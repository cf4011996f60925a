#include "ldni/sweep/loop_resolver.h"

#include "csg/scene.h"
#include "ldni/section/chain_builder.h"
#include "ldni/sweep/detail/program_states.h"
#include "ldni/sweep/detail/ray_sweep.h"

namespace lamina::ldni {
namespace {

csg::Scene one_leaf() {
  csg::Scene scene;
  scene.leaves.resize(1);
  scene.leaves[0].may_overlap_itself = true;
  scene.instances.resize(1);
  scene.program.push_back({csg::BooleanOp::kUnion, 0, false, 1});
  return scene;
}

}  // namespace

struct LoopResolver::State {
  State(const SweepOptions& options, FillRule rule)
      : scene(one_leaf()), states(scene, rule), sweep(options) {
    block.layer_count = 1;
  }

  const csg::Scene scene;
  detail::ProgramStates states;
  detail::RaySweep sweep;
  ChainBuilder builder;
  ChainBlock block;
};

LoopResolver::LoopResolver(const SweepOptions& options, FillRule rule)
    : state_(std::make_unique<State>(options, rule)) {}

LoopResolver::~LoopResolver() = default;

void LoopResolver::resolve(Contours& contours) {
  ChainBuilder& builder = state_->builder;
  builder.begin(state_->block);
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    const auto loop = contours.loop(i);
    builder.loop().assign(loop.begin(), loop.end());
    builder.close_loop(0, 0, 1);
  }
  builder.finish(state_->block);
  state_->sweep.begin(state_->block.chains_of(0), state_->states);
  state_->sweep.resume(contours, {});
}

SweepCounts LoopResolver::counts() const { return state_->sweep.counts(); }

}  // namespace lamina::ldni
