#include <algorithm>
#include <cstddef>
#include <string_view>

#include "csg/solid/detail/lowerer.h"

namespace lamina::csg {
namespace {

std::size_t count_operands(const Node& node) {
  return static_cast<std::size_t>(
      std::count_if(node.children.begin(), node.children.end(),
                    [](const Node* child) { return !child->is_background; }));
}

Shape lower_later(const Node& node, std::string_view module) {
  if (count_operands(node) > 0) fail_unsupported(node, module);
  return {};
}

}  // namespace

Shape Lowerer::lower_op(const Hull&, const Node& node, const Affine&) {
  return lower_later(node, "hull");
}

Shape Lowerer::lower_op(const Minkowski&, const Node& node,
                        const Affine& world) {
  // The sum of one operand is that operand.
  if (count_operands(node) == 1) {
    return lower_children(node, world, BooleanOp::kUnion);
  }
  return lower_later(node, "minkowski");
}

Shape Lowerer::lower_op(const Resize&, const Node& node, const Affine&) {
  return lower_later(node, "resize");
}

Shape Lowerer::lower_op(const Projection&, const Node& node, const Affine&) {
  return lower_later(node, "projection");
}

}  // namespace lamina::csg
