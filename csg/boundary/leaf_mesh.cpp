#include "csg/boundary/leaf_mesh.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <glm/geometric.hpp>

#include "csg/boundary/leaf_faces.h"

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

// Returns the range of row · vertex over all vertices of the loft.
Range range_along(const Loft& loft, Vec3 row) {
  Range plan;
  for (const Vec2 point : *loft.outline) {
    plan.add(row.x * point.x + row.y * point.y);
  }
  Range range;
  for (const Vec2 ring : loft.profile) {
    range.add(ring.x * plan.low + row.z * ring.y);
    range.add(ring.x * plan.high + row.z * ring.y);
  }
  return range;
}

void extend(Box3& box, const Loft& loft, const Affine& linear) {
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 row(linear[0][axis], linear[1][axis], linear[2][axis]);
    const Range range = range_along(loft, row);
    box.low[axis] = std::min(box.low[axis], range.low);
    box.high[axis] = std::max(box.high[axis], range.high);
  }
}

void extend(Box3& box, const Mesh& mesh, const Affine& linear) {
  Range x, y, z;
  for (const Vec3 v : mesh.vertices) {
    x.add(linear[0].x * v.x + linear[1].x * v.y + linear[2].x * v.z);
    y.add(linear[0].y * v.x + linear[1].y * v.y + linear[2].y * v.z);
    z.add(linear[0].z * v.x + linear[1].z * v.y + linear[2].z * v.z);
  }
  box.add(Box3{{x.low, y.low, z.low}, {x.high, y.high, z.high}});
}

}  // namespace

void append(Mesh& mesh, const Mesh& other) {
  const auto shift = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(),
                       other.vertices.end());
  for (const auto& [a, b, c] : other.triangles) {
    mesh.triangles.push_back({a + shift, b + shift, c + shift});
  }
}

Mesh explicit_mesh(const Leaf& leaf) {
  Mesh result;
  // One by one: together, caps of cavities would be cut out of those around
  // them.
  for (const Loft& loft : leaf.lofts) {
    Leaf alone;
    alone.lofts.push_back(loft);
    alone.lofts.front().is_cavity = false;
    LeafFaces faces = faces_of(alone, Affine(1.0));
    if (loft.is_cavity) {
      for (auto& t : faces.triangles) std::swap(t[1], t[2]);
    }
    append(result, {std::move(faces.vertices), std::move(faces.triangles)});
  }
  for (const Mesh& mesh : leaf.meshes) append(result, mesh);
  return result;
}

double signed_volume(const Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    sum += glm::dot(mesh.vertices[t[0]],
                    glm::cross(mesh.vertices[t[1]], mesh.vertices[t[2]]));
  }
  return sum / 6;
}

Box3 bound_leaf(const Leaf& leaf, const Affine& linear) {
  Box3 box;
  for (const Loft& loft : leaf.lofts) extend(box, loft, linear);
  for (const Mesh& mesh : leaf.meshes) extend(box, mesh, linear);
  return box;
}

}  // namespace lamina::csg
