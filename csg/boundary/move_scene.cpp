#include "csg/boundary/move_scene.h"

#include <glm/common.hpp>

#include "csg/boundary/leaf_box.h"

namespace lamina::csg {
namespace {

Box3 turn_box(const Box3& box, const Affine& turn) {
  if (box.is_empty()) return box;
  const Vec3 a = turn * Vec4(box.low, 1);
  const Vec3 b = turn * Vec4(box.high, 1);
  return {glm::min(a, b), glm::max(a, b)};
}

}  // namespace

void move_scene(Scene& scene, const Affine& turn, Vec3 shift) {
  for (Instance& instance : scene.instances) {
    Affine& map = instance.world_from_leaf;
    map = turn * Mat4(map);
    map[3] += shift;
    instance.box = shift_box(turn_box(instance.box, turn), shift);
  }
  scene.box = shift_box(turn_box(scene.box, turn), shift);
}

}  // namespace lamina::csg
