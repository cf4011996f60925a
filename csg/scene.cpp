#include "csg/scene.h"

#include <cstddef>

namespace lamina::csg {

Box3 bounds_of(const Scene& scene) {
  struct Bounds {
    Box3 box;
    bool is_open = true;  // no child was there yet
  };
  std::vector<Bounds> bounds(scene.program.size());
  const auto add = [&](const auto& child, const Box3& box) {
    const plane::BooleanNode& parent = scene.program[child.parent];
    Bounds& of = bounds[child.parent];
    if (parent.op == plane::BooleanOp::kIntersection) {
      if (of.is_open) of.box = box;
      of.box.intersect(box);
      if (of.box.is_empty()) of.box = {};
    } else if (parent.op == plane::BooleanOp::kUnion || child.is_minuend) {
      of.box.add(box);
    }
    of.is_open = false;
  };
  for (const Instance& instance : scene.instances) add(instance, instance.box);
  for (std::size_t n = scene.program.size(); n-- > 1;) {
    add(scene.program[n], bounds[n].box);
  }
  return bounds[0].box;
}

plane::BooleanProgram program_of(const Scene& scene) {
  plane::BooleanProgram program{scene.program, {}};
  program.operands.reserve(scene.instances.size());
  for (const Instance& instance : scene.instances) {
    const Box3& box = instance.box;
    program.operands.push_back(
        {{Vec2(box.low), Vec2(box.high)},
         instance.parent,
         instance.is_minuend,
         scene.leaves[instance.leaf].may_overlap_itself});
  }
  return program;
}

}  // namespace lamina::csg
