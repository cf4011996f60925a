#pragma once
// Boolean programs of any shape.

#include <cstdint>
#include <random>

#include "csg/scene.h"

namespace lamina::csg {

// A random program of `depth` levels; leaves are instances without geometry.
inline void add_random_children(Scene& scene, std::uint32_t parent, int depth,
                                std::mt19937& random) {
  const auto count = 1 + random() % 4;
  scene.program[parent].child_count = static_cast<std::uint32_t>(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (depth == 0 || random() % 2 == 0) {
      Instance instance;
      instance.parent = parent;
      instance.is_minuend = i == 0;
      scene.instances.push_back(instance);
      continue;
    }
    BooleanNode node;
    node.op = static_cast<BooleanOp>(random() % 3);
    node.parent = parent;
    node.is_minuend = i == 0;
    scene.program.push_back(node);
    add_random_children(scene,
                        static_cast<std::uint32_t>(scene.program.size() - 1),
                        depth - 1, random);
  }
}

inline Scene random_program(std::mt19937& random) {
  Scene scene;
  scene.program.push_back({static_cast<BooleanOp>(random() % 3), 0, false, 0});
  add_random_children(scene, 0, 4, random);
  return scene;
}

}  // namespace lamina::csg
