#include "plane/program/program_state.h"

namespace lamina::plane {

ProgramState::ProgramState(const BooleanProgram& program) {
  nodes_.reserve(program.nodes.size());
  for (const BooleanNode& node : program.nodes) {
    nodes_.push_back({0, threshold_of(node),
                      Child(node.parent, is_subtrahend(program.nodes, node))});
  }
  operands_.reserve(program.operands.size());
  for (const Operand& operand : program.operands) {
    operands_.push_back(
        {Child(operand.parent, is_subtrahend(program.nodes, operand)),
         kOutside});
  }
}

void ProgramState::reset() {
  while (!inside_.empty()) flip(inside_.back(), false);
}

}  // namespace lamina::plane
