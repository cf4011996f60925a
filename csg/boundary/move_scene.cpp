#include "csg/boundary/move_scene.h"

#include <cmath>

#include <glm/geometric.hpp>

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

Affine inverse_of(const Affine& turn) {
  return {Vec3(turn[0].x, turn[1].x, turn[2].x),
          Vec3(turn[0].y, turn[1].y, turn[2].y),
          Vec3(turn[0].z, turn[1].z, turn[2].z), Vec3(0)};
}

Vec3 perpendicular_to(Vec3 direction) {
  return glm::normalize(glm::cross(
      direction, std::abs(direction.z) < 0.9 ? Vec3(0, 0, 1) : Vec3(1, 0, 0)));
}

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

std::uint32_t add_operand(const Scene& part, const Affine& motion,
                          std::uint32_t parent, std::uint32_t leaves,
                          Scene& scene) {
  const auto first = static_cast<std::uint32_t>(scene.program.size());
  for (plane::BooleanNode node : part.program) {
    node.parent += first;
    scene.program.push_back(node);
  }
  scene.program[first].parent = parent;
  scene.program[first].is_minuend = false;
  ++scene.program[parent].child_count;
  for (Instance instance : part.instances) {
    instance.leaf += leaves;
    instance.parent += first;
    if (motion != Affine(1.0)) {
      Affine& matrix = instance.world_from_leaf;
      matrix = motion * Mat4(matrix);
      instance.box =
          bound_leaf(scene.leaves[instance.leaf], matrix).shifted(matrix[3]);
    }
    scene.instances.push_back(instance);
  }
  return first;
}

}  // namespace lamina::csg
