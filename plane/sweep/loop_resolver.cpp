#include "plane/sweep/loop_resolver.h"

#include "plane/chain_builder.h"
#include "plane/program/boolean_program.h"
#include "plane/program/program_states.h"
#include "plane/sweep/ray_sweep.h"

namespace lamina::plane {
namespace {

// Loops cross often where a sweep meets more swaps than so many for each chain
// met so far, and at the beginning a share of those of all chains and some. To
// unite parts costs as much as ten swaps a chain; half of them are met before
// the sweep is given up.
constexpr double kFewSwaps = 8;
constexpr double kFirstShare = 0.25;
constexpr double kFirstSwaps = 256;

BooleanProgram one_operand() {
  BooleanProgram program = program_of(BooleanOp::kUnion, 1);
  program.operands[0].may_overlap_itself = true;
  return program;
}

}  // namespace

struct LoopResolver::State {
  State(const SweepOptions& options, FillRule rule)
      : program(one_operand()), states(program, rule), sweep(options) {
    block.layer_count = 1;
  }

  void begin(const Contours& contours) {
    builder.begin(block);
    for (std::size_t i = 0; i < contours.loop_count(); ++i) {
      const auto loop = contours.loop(i);
      builder.loop().assign(loop.begin(), loop.end());
      builder.close_loop(0, 0, 1);
    }
    builder.finish(block);
    sweep.begin(block.chains_of(0), states);
  }

  const BooleanProgram program;
  ProgramStates states;
  RaySweep sweep;
  ChainBuilder builder;
  ChainBlock block;
};

LoopResolver::LoopResolver(const SweepOptions& options, FillRule rule)
    : state_(std::make_unique<State>(options, rule)) {}

LoopResolver::~LoopResolver() = default;

void LoopResolver::resolve(Contours& contours) {
  state_->begin(contours);
  state_->sweep.resume(contours, {});
}

bool LoopResolver::resolve_few_crossings(Contours& contours) {
  state_->begin(contours);
  const auto chains = static_cast<double>(state_->block.chains.size());
  return state_->sweep.resume(
      contours, {kFewSwaps, kFirstSwaps + kFirstShare * kFewSwaps * chains});
}

SweepCounts LoopResolver::counts() const { return state_->sweep.counts(); }

}  // namespace lamina::plane
