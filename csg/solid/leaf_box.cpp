#include "csg/solid/detail/leaf_box.h"

#include <algorithm>

#include <glm/common.hpp>

namespace lamina::csg {
namespace {

struct Range {
  double low = 1e300;
  double high = -1e300;

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

// Range of row · vertex over all vertices of the sweep.
Range range_along(const Sweep& sweep, Vec3 row) {
  Range plan;
  for (const Vec2 point : *sweep.outline) {
    plan.add(row.x * point.x + row.y * point.y);
  }
  Range range;
  for (const Vec2 ring : sweep.profile) {
    range.add(ring.x * plan.low + row.z * ring.y);
    range.add(ring.x * plan.high + row.z * ring.y);
  }
  return range;
}

Range range_along(const Mesh& mesh, Vec3 row) {
  Range range;
  for (const Vec3 vertex : mesh.vertices) {
    range.add(row.x * vertex.x + row.y * vertex.y + row.z * vertex.z);
  }
  return range;
}

}  // namespace

Box3 bound_leaf(const Leaf& leaf, const Affine& linear) {
  Box3 box;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 row(linear[0][axis], linear[1][axis], linear[2][axis]);
    const auto extend = [&](const auto& part) {
      const Range range = range_along(part, row);
      box.low[axis] = std::min(box.low[axis], range.low);
      box.high[axis] = std::max(box.high[axis], range.high);
    };
    for (const Sweep& sweep : leaf.sweeps) extend(sweep);
    for (const Mesh& mesh : leaf.meshes) extend(mesh);
  }
  return box;
}

Box3 shift_box(const Box3& box, Vec3 shift) {
  return {box.low + shift, box.high + shift};
}

Box3 unite_boxes(const Box3& a, const Box3& b) {
  return {glm::min(a.low, b.low), glm::max(a.high, b.high)};
}

Box3 intersect_boxes(const Box3& a, const Box3& b) {
  return {glm::max(a.low, b.low), glm::min(a.high, b.high)};
}

}  // namespace lamina::csg
