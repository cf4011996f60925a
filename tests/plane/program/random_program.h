#pragma once
// Boolean programs of any shape.

#include <cstdint>
#include <random>

#include "plane/program/boolean_program.h"

namespace lamina::plane {

// A random program of `depth` levels; operands have no boxes.
inline void add_random_children(BooleanProgram& program, std::uint32_t parent,
                                int depth, std::mt19937& random) {
  const auto count = 1 + random() % 4;
  program.nodes[parent].child_count = static_cast<std::uint32_t>(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (depth == 0 || random() % 2 == 0) {
      Operand operand;
      operand.parent = parent;
      operand.is_minuend = i == 0;
      program.operands.push_back(operand);
      continue;
    }
    BooleanNode node;
    node.op = static_cast<BooleanOp>(random() % 3);
    node.parent = parent;
    node.is_minuend = i == 0;
    program.nodes.push_back(node);
    add_random_children(program,
                        static_cast<std::uint32_t>(program.nodes.size() - 1),
                        depth - 1, random);
  }
}

inline BooleanProgram random_program(std::mt19937& random) {
  BooleanProgram program;
  program.nodes.push_back({static_cast<BooleanOp>(random() % 3), 0, false, 0});
  add_random_children(program, 0, 4, random);
  return program;
}

}  // namespace lamina::plane
