#include "csg/boundary/move_scene.h"

#include <cstddef>
#include <vector>

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

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

Box3 overlap(const Box3& a, const Box3& b) {
  Box3 both;
  both.low = glm::max(a.low, b.low);
  both.high = glm::min(a.high, b.high);
  return glm::all(glm::lessThanEqual(both.low, both.high)) ? both : Box3{};
}

// Bounds of what a program makes of its leaves: see Scene::box.
Box3 bound_program(const Scene& scene) {
  struct Bounds {
    Box3 box;
    bool is_open = true;  // no child was there yet
  };
  std::vector<Bounds> bounds(scene.program.size());
  const auto add = [&](const auto& child, const Box3& box) {
    const plane::BooleanNode& parent = scene.program[child.parent];
    Bounds& of = bounds[child.parent];
    if (parent.op == plane::BooleanOp::kIntersection) {
      of.box = of.is_open ? box : overlap(of.box, box);
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
  scene.box = bound_program(scene);
}

}  // namespace lamina::csg
