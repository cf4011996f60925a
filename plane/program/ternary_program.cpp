#include "plane/program/ternary_program.h"

#include "plane/program/program_state.h"

namespace lamina::plane {

TernaryProgram::TernaryProgram(const BooleanProgram& program, Ternary initial) {
  nodes_.reserve(program.nodes.size());
  for (const BooleanNode& node : program.nodes) {
    Node& own = nodes_.emplace_back();
    own.threshold = threshold_of(node);
    own.parent = node.parent;
    own.is_subtrahend = is_subtrahend(program.nodes, node);
  }
  members_.reserve(program.operands.size());
  for (const Operand& operand : program.operands) {
    members_.push_back({operand.parent, is_subtrahend(program.nodes, operand),
                        Ternary::kFalse});
  }
  if (initial == Ternary::kFalse) return;
  for (std::uint32_t i = 0; i < members_.size(); ++i) set(i, initial);
}

void TernaryProgram::set(std::uint32_t operand, Ternary value) {
  Member& member = members_[operand];
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

bool TernaryProgram::matters(std::uint32_t operand) const {
  if (members_[operand].value != Ternary::kUnknown) return false;
  std::uint32_t node = members_[operand].parent;
  while (node != 0 && !is_decided(node)) node = nodes_[node].parent;
  return !is_decided(node);
}

}  // namespace lamina::plane
