#include "plane/cascade/active_zones.h"

#include <algorithm>
#include <cstdint>

namespace lamina::plane {
namespace {

// Adds one of its operands to the box of an operator.
void add_operand(BooleanOp op, bool is_minuend, const Box2& operand,
                 Box2& box) {
  if (op == BooleanOp::kIntersection) {
    box.intersect(operand);
  } else if (op == BooleanOp::kUnion || is_minuend) {
    box.add(operand);
  }
}

}  // namespace

bool has_active_zones(const BooleanProgram& program) {
  return std::ranges::any_of(program.nodes, [](const BooleanNode& node) {
    return node.op != BooleanOp::kUnion;
  });
}

std::vector<Box2> active_zones(const BooleanProgram& program,
                               std::span<const Box2> boxes) {
  std::vector<Box2> zones(program.nodes.size());
  for (std::uint32_t i = 0; i < zones.size(); ++i) {
    const BooleanNode& node = program.nodes[i];
    // An intersection of nothing is empty.
    if (node.op == BooleanOp::kIntersection && node.child_count > 0) {
      zones[i] = {Vec2(-1e300), Vec2(1e300)};
    }
  }
  const auto add = [&](std::uint32_t parent, bool is_minuend,
                       const Box2& operand) {
    add_operand(program.nodes[parent].op, is_minuend, operand, zones[parent]);
  };
  for (std::uint32_t i = 0; i < program.operands.size(); ++i) {
    const Operand& operand = program.operands[i];
    add(operand.parent, operand.is_minuend, boxes[i]);
  }
  // Parents come before their children.
  for (std::size_t i = zones.size(); i-- > 1;) {
    const BooleanNode& node = program.nodes[i];
    add(node.parent, node.is_minuend, zones[i]);
  }
  for (std::size_t i = 1; i < zones.size(); ++i) {
    zones[i].intersect(zones[program.nodes[i].parent]);
  }
  return zones;
}

}  // namespace lamina::plane
