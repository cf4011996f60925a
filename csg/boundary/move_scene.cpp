#include "csg/boundary/move_scene.h"

#include "csg/boundary/leaf_mesh.h"

namespace lamina::csg {
namespace {

Box3 turn_box(const Box3& box, const Affine& turn) {
  if (box.is_empty()) return box;
  Box3 turned;
  turned.add(turn * Vec4(box.low, 1));
  turned.add(turn * Vec4(box.high, 1));
  return turned;
}

}  // namespace

void move_scene(Scene& scene, const Affine& turn, Vec3 shift) {
  for (Instance& instance : scene.instances) {
    Affine& map = instance.world_from_leaf;
    map = turn * Mat4(map);
    map[3] += shift;
    instance.box = turn_box(instance.box, turn).shifted(shift);
  }
  scene.box = turn_box(scene.box, turn).shifted(shift);
}

void turn_scene(Scene& scene, const Affine& rotation) {
  for (Instance& instance : scene.instances) {
    Affine& map = instance.world_from_leaf;
    map = rotation * Mat4(map);
    instance.box = bound_leaf(scene.leaves[instance.leaf], map).shifted(map[3]);
  }
  scene.box = bounds_of(scene);
}

}  // namespace lamina::csg
