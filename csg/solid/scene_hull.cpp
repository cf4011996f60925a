#include "csg/solid/detail/scene_hull.h"

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "csg/solid/boundary_faces.h"
#include "csg/solid/detail/convex_hull.h"
#include "csg/solid/detail/united.h"
#include "csg/solid/leaf_mesh.h"

namespace lamina::csg {
namespace {

// Instances of one leaf that differ by their shifts only.
using Linear = std::array<double, 9>;
using Shifts = std::map<std::pair<std::uint32_t, Linear>, std::vector<Vec3>>;

Linear linear_of(const Affine& m) {
  return {m[0].x, m[0].y, m[0].z, m[1].x, m[1].y,
          m[1].z, m[2].x, m[2].y, m[2].z};
}

Affine affine_of(const Linear& m, Vec3 shift) {
  return {{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}, shift};
}

Shifts shifts_of(const std::vector<Instance>& instances) {
  Shifts shifts;
  for (const Instance& instance : instances) {
    const Affine& m = instance.world_from_leaf;
    shifts[{instance.leaf, linear_of(m)}].push_back(m[3]);
  }
  return shifts;
}

}  // namespace

Mesh convex_hull(Scene scene) {
  std::vector<Vec3> points;
  for (auto& [shape, shifts] : shifts_of(take_united(scene))) {
    const auto& [leaf, linear] = shape;
    const std::vector<Vec3> vertices =
        explicit_mesh(scene.leaves[leaf]).vertices;
    for (const Vec3 shift : extreme_points(shifts)) {
      const Affine m = affine_of(linear, shift);
      for (const Vec3 vertex : vertices) points.push_back(m * Vec4(vertex, 1));
    }
  }
  for (const BoundaryFace& face : boundary_faces(scene)) {
    for (const auto& contour : face.contours) {
      points.insert(points.end(), contour.begin(), contour.end());
    }
  }
  return convex_hull(std::move(points));
}

}  // namespace lamina::csg
