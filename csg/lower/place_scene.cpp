// Puts a scene that was lowered apart on the builder's stack.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "csg/lower/detail/lowerer.h"

namespace lamina::csg {
namespace {

// A child of an operator, an operator or an instance itself.
struct Child {
  std::uint32_t index = 0;
  bool is_operator = false;
};

// The children of each operator, the minuend of a difference first.
std::vector<std::vector<Child>> list_children(const Scene& scene) {
  std::vector<std::vector<Child>> children(scene.program.size());
  const auto add = [&](const auto& item, Child child) {
    std::vector<Child>& all = children[item.parent];
    all.insert(item.is_minuend ? all.begin() : all.end(), child);
  };
  for (std::uint32_t n = 1; n < scene.program.size(); ++n) {
    add(scene.program[n], {n, true});
  }
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    add(scene.instances[i], {i, false});
  }
  return children;
}

}  // namespace

void Lowerer::place_scene(const Scene& scene, const Affine& world) {
  const auto children = list_children(scene);
  std::vector<std::uint32_t> leaves;
  for (const Leaf& leaf : scene.leaves) leaves.push_back(leaves_.add(leaf));
  const auto place_instance = [&](Instance instance) {
    const Affine& m = instance.world_from_leaf;
    instance.leaf = leaves[instance.leaf];
    instance.world_from_leaf = world * Mat4(m);
    instance.box = bound(instance.leaf, instance.world_from_leaf);
    builder_.push(instance);
  };
  const auto place_operator = [&](const auto& self, std::uint32_t n) -> void {
    std::vector<std::size_t> begins;
    for (const Child& child : children[n]) {
      begins.push_back(builder_.mark());
      if (child.is_operator) {
        self(self, child.index);
      } else {
        place_instance(scene.instances[child.index]);
      }
    }
    if (begins.empty()) return;
    if (scene.program[n].op == BooleanOp::kDifference) {
      builder_.apply_difference(begins);
    } else if (scene.program[n].op == BooleanOp::kIntersection) {
      builder_.apply_intersection(begins);
    }
  };
  place_operator(place_operator, 0);
}

}  // namespace lamina::csg
