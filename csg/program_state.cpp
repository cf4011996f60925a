#include "csg/program_state.h"

namespace lamina::csg {

ProgramState::ProgramState(const Scene& scene) {
  nodes_.reserve(scene.program.size());
  for (const BooleanNode& node : scene.program) {
    nodes_.push_back({0, threshold_of(node),
                      Child(node.parent, is_subtrahend(scene, node))});
  }
  instances_.reserve(scene.instances.size());
  for (const Instance& instance : scene.instances) {
    instances_.push_back(
        {Child(instance.parent, is_subtrahend(scene, instance)), kOutside});
  }
}

void ProgramState::reset() {
  while (!inside_.empty()) flip(inside_.back(), false);
}

}  // namespace lamina::csg
