#include "csg/program_state.h"

#include <algorithm>

namespace lamina::csg {

ProgramState::ProgramState(const Scene& scene) {
  const auto is_subtrahend = [&](std::uint32_t parent, bool is_minuend) {
    return scene.program[parent].op == BooleanOp::kDifference && !is_minuend;
  };
  nodes_.reserve(scene.program.size());
  for (const BooleanNode& node : scene.program) {
    Node state;
    if (node.op == BooleanOp::kIntersection) {
      // An intersection of nothing is empty, as in OpenSCAD.
      state.threshold =
          std::max(1, static_cast<std::int32_t>(node.child_count));
    }
    state.child =
        Child(node.parent, is_subtrahend(node.parent, node.is_minuend));
    nodes_.push_back(state);
  }
  instances_.reserve(scene.instances.size());
  for (const Instance& instance : scene.instances) {
    InstanceState state;
    state.child = Child(instance.parent,
                        is_subtrahend(instance.parent, instance.is_minuend));
    instances_.push_back(state);
  }
}

void ProgramState::reset() {
  while (!inside_.empty()) flip(inside_.back(), false);
}

}  // namespace lamina::csg
