#pragma once
// Meshes made by hand, for the judges' own tests.

#include <cmath>
#include <utility>
#include <vector>

#include "tests/oracle/world_scene.h"

namespace lamina::oracle {

// A box as twelve triangles.
inline csg::Mesh box(Vec3 low, Vec3 high) {
  csg::Mesh mesh;
  for (unsigned i = 0; i < 8; ++i) {
    mesh.vertices.push_back({(i & 1) != 0 ? high.x : low.x,
                             (i & 2) != 0 ? high.y : low.y,
                             (i & 4) != 0 ? high.z : low.z});
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6},
                    {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                    {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

// About the z axis.
inline void turn(csg::Mesh& mesh, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  for (Vec3& v : mesh.vertices) v = {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
}

// One operator over meshes; the first is the minuend.
inline WorldScene scene_of(plane::BooleanOp op, std::vector<csg::Mesh> meshes) {
  WorldScene scene;
  const auto count = static_cast<std::uint32_t>(meshes.size());
  scene.program = {{op, 0, false, count}};
  scene.parent.assign(count, 0);
  scene.is_minuend.assign(count, false);
  if (op == plane::BooleanOp::kDifference) scene.is_minuend[0] = true;
  scene.meshes = std::move(meshes);
  return scene;
}

// (block - bar) + (bar ∩ post), all turned.
inline WorldScene nested_scene(double angle) {
  using plane::BooleanOp;
  WorldScene scene;
  scene.program = {{BooleanOp::kUnion, 0, false, 2},
                   {BooleanOp::kDifference, 0, false, 2},
                   {BooleanOp::kIntersection, 0, false, 2}};
  scene.meshes = {box({0, 0, 0}, {6, 6, 4}), box({1, 1, 1}, {5, 7, 3}),
                  box({1, 1, 1}, {5, 7, 3}), box({2, 2, -1}, {3, 3, 9})};
  scene.parent = {1, 1, 2, 2};
  scene.is_minuend = {true, false, false, false};
  for (csg::Mesh& mesh : scene.meshes) turn(mesh, angle);
  return scene;
}

}  // namespace lamina::oracle
