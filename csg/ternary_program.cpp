#include "csg/ternary_program.h"

#include "csg/program_state.h"

namespace lamina::csg {

TernaryProgram::TernaryProgram(const Scene& scene, Ternary initial) {
  nodes_.reserve(scene.program.size());
  for (const BooleanNode& node : scene.program) {
    Node& own = nodes_.emplace_back();
    own.threshold = threshold_of(node);
    own.parent = node.parent;
    own.is_subtrahend = is_subtrahend(scene, node);
  }
  members_.reserve(scene.instances.size());
  for (const Instance& instance : scene.instances) {
    members_.push_back(
        {instance.parent, is_subtrahend(scene, instance), Ternary::kFalse});
  }
  if (initial == Ternary::kFalse) return;
  for (std::uint32_t i = 0; i < members_.size(); ++i) set(i, initial);
}

void TernaryProgram::set(std::uint32_t instance, Ternary value) {
  Member& member = members_[instance];
  Range before = range_of(member.value);
  Range after = range_of(value);
  member.value = value;
  bool is_subtrahend = member.is_subtrahend;
  std::uint32_t index = member.parent;
  while (before.surely != after.surely || before.maybe != after.maybe) {
    const int surely = int{after.surely} - int{before.surely};
    const int maybe = int{after.maybe} - int{before.maybe};
    Node& node = nodes_[index];
    before = node.range();
    node.least += is_subtrahend ? -maybe : surely;
    node.most += is_subtrahend ? -surely : maybe;
    after = node.range();
    if (index == 0) return;
    is_subtrahend = node.is_subtrahend;
    index = node.parent;
  }
}

bool TernaryProgram::matters(std::uint32_t instance) const {
  if (members_[instance].value != Ternary::kUnknown) return false;
  std::uint32_t node = members_[instance].parent;
  while (node != 0 && !is_decided(node)) node = nodes_[node].parent;
  return !is_decided(node);
}

}  // namespace lamina::csg
