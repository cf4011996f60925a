#include "csg/boundary/program_range.h"

#include <algorithm>

namespace lamina::csg {

ProgramRange::ProgramRange(const Scene& scene) {
  const auto is_subtrahend = [&](std::uint32_t parent, bool is_minuend) {
    return scene.program[parent].op == BooleanOp::kDifference && !is_minuend;
  };
  nodes_.reserve(scene.program.size());
  for (const BooleanNode& node : scene.program) {
    Node& own = nodes_.emplace_back();
    if (node.op == BooleanOp::kIntersection) {
      own.threshold = std::max(1, static_cast<std::int32_t>(node.child_count));
    }
    own.parent = node.parent;
    own.is_subtrahend = is_subtrahend(node.parent, node.is_minuend);
  }
  members_.reserve(scene.instances.size());
  for (const Instance& instance : scene.instances) {
    members_.push_back({instance.parent,
                        is_subtrahend(instance.parent, instance.is_minuend),
                        Knowledge::kOutside});
  }
}

void ProgramRange::set(std::uint32_t instance, Knowledge knowledge) {
  Member& member = members_[instance];
  Range before = range_of(member.knowledge);
  Range after = range_of(knowledge);
  member.knowledge = knowledge;
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

bool ProgramRange::matters(std::uint32_t instance) const {
  if (members_[instance].knowledge != Knowledge::kUnknown) return false;
  std::uint32_t node = members_[instance].parent;
  while (node != 0 && !is_decided(node)) node = nodes_[node].parent;
  return !is_decided(node);
}

}  // namespace lamina::csg
