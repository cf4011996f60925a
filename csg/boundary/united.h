#pragma once
// Leaves that the program only unites: their surfaces need no Boolean.

#include <utility>
#include <vector>

#include "csg/scene.h"

namespace lamina::csg {

// Takes the instances directly below a root that is a union out of the scene;
// what is left needs a Boolean.
inline std::vector<Instance> take_united(Scene& scene) {
  std::vector<Instance> united;
  if (scene.program[0].op != plane::BooleanOp::kUnion) return united;
  std::erase_if(scene.instances, [&](const Instance& instance) {
    if (instance.parent != 0) return false;
    united.push_back(instance);
    --scene.program[0].child_count;
    return true;
  });
  return united;
}

}  // namespace lamina::csg
