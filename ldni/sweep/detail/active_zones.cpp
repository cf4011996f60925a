#include "ldni/sweep/detail/active_zones.h"

#include <algorithm>
#include <cstdint>

namespace lamina::ldni::detail {
namespace {

// Tells an operator of one of its operands.
void add_operand(csg::BooleanOp op, bool is_minuend, const Box2& operand,
                 Box2& box) {
  if (op == csg::BooleanOp::kIntersection) {
    box.intersect(operand);
  } else if (op == csg::BooleanOp::kUnion || is_minuend) {
    box.add(operand);
  }
}

}  // namespace

bool has_active_zones(const csg::Scene& scene) {
  return std::ranges::any_of(scene.program, [](const csg::BooleanNode& node) {
    return node.op != csg::BooleanOp::kUnion;
  });
}

std::vector<Box2> active_zones(const csg::Scene& scene,
                               std::span<const Box2> boxes) {
  std::vector<Box2> zones(scene.program.size());
  for (std::uint32_t i = 0; i < zones.size(); ++i) {
    const csg::BooleanNode& node = scene.program[i];
    // Of nothing at all an intersection is empty.
    if (node.op == csg::BooleanOp::kIntersection && node.child_count > 0) {
      zones[i] = {Vec2(-1e300), Vec2(1e300)};
    }
  }
  const auto add = [&](std::uint32_t parent, bool is_minuend,
                       const Box2& operand) {
    add_operand(scene.program[parent].op, is_minuend, operand, zones[parent]);
  };
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const csg::Instance& instance = scene.instances[i];
    add(instance.parent, instance.is_minuend, boxes[i]);
  }
  // Parents stand before their children.
  for (std::size_t i = zones.size(); i-- > 1;) {
    const csg::BooleanNode& node = scene.program[i];
    add(node.parent, node.is_minuend, zones[i]);
  }
  for (std::size_t i = 1; i < zones.size(); ++i) {
    zones[i].intersect(zones[scene.program[i].parent]);
  }
  return zones;
}

}  // namespace lamina::ldni::detail
