#include "csg/scene.h"

namespace lamina::csg {

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
