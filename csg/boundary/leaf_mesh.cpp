#include "csg/boundary/leaf_mesh.h"

#include <algorithm>
#include <cstddef>

#include <glm/geometric.hpp>

#include "plane/region/triangulate.h"

namespace lamina::csg {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

void add_triangle(Mesh& mesh, bool is_cavity, Triangle t) {
  if (is_cavity) std::swap(t[1], t[2]);
  mesh.triangles.push_back(t);
}

// Appends one loft; an apex is one vertex, not a ring of equal ones.
class LoftExpander {
 public:
  LoftExpander(const Loft& loft, Mesh& mesh) : loft_(loft), mesh_(mesh) {}

  void expand() {
    add_vertices();
    const std::size_t rings = loft_.profile.size();
    const std::size_t bands = loft_.is_closed_profile ? rings : rings - 1;
    for (std::size_t i = 0; i < bands; ++i) add_band(i, (i + 1) % rings);
    if (loft_.is_closed_profile) return;
    add_cap(0, true);
    add_cap(rings - 1, false);
  }

 private:
  bool is_apex(std::size_t ring) const { return loft_.profile[ring].x == 0; }

  void add_vertices() {
    for (const Vec2 ring : loft_.profile) {
      ring_begins_.push_back(static_cast<std::uint32_t>(mesh_.vertices.size()));
      if (ring.x == 0) {
        mesh_.vertices.push_back({0, 0, ring.y});
        continue;
      }
      for (const Vec2 point : *loft_.outline) {
        mesh_.vertices.push_back({ring.x * point.x, ring.x * point.y, ring.y});
      }
    }
  }

  std::uint32_t vertex(std::size_t ring, std::size_t j) const {
    const std::size_t point = is_apex(ring) ? 0 : j % loft_.outline->size();
    return ring_begins_[ring] + static_cast<std::uint32_t>(point);
  }

  void add_band(std::size_t low, std::size_t high) {
    for (std::size_t j = 0; j < loft_.outline->size(); ++j) {
      if (!is_apex(low)) {
        add_triangle(mesh_, loft_.is_cavity,
                     {vertex(low, j), vertex(low, j + 1), vertex(high, j + 1)});
      }
      if (!is_apex(high)) {
        add_triangle(mesh_, loft_.is_cavity,
                     {vertex(low, j), vertex(high, j + 1), vertex(high, j)});
      }
    }
  }

  void add_cap(std::size_t ring, bool faces_down) {
    if (is_apex(ring)) return;
    const plane::Region cap{{*loft_.outline}};
    for (const Triangle& t : plane::triangulate(cap)) {
      add_triangle(
          mesh_, loft_.is_cavity != faces_down,
          {vertex(ring, t[0]), vertex(ring, t[1]), vertex(ring, t[2])});
    }
  }

  const Loft& loft_;
  Mesh& mesh_;
  std::vector<std::uint32_t> ring_begins_;
};

struct Range {
  double low = 1e300;
  double high = -1e300;

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

// Range of row · vertex over all vertices of the loft.
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

Mesh explicit_mesh(const Leaf& leaf) {
  Mesh result;
  for (const Loft& loft : leaf.lofts) LoftExpander(loft, result).expand();
  for (const Mesh& mesh : leaf.meshes) {
    const auto shift = static_cast<std::uint32_t>(result.vertices.size());
    result.vertices.insert(result.vertices.end(), mesh.vertices.begin(),
                           mesh.vertices.end());
    for (const Triangle& t : mesh.triangles) {
      result.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
    }
  }
  return result;
}

double signed_volume(const Mesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
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
