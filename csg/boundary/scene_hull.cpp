#include "csg/boundary/scene_hull.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "csg/boundary/boundary_faces.h"
#include "csg/boundary/convex_hull.h"
#include "csg/boundary/leaf_mesh.h"
#include "csg/boundary/united.h"
#include "csg/tie_distance.h"

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

// The hull of the points so far. Most faces of a Boolean soon lie inside of it,
// and add nothing.
class GrowingHull {
 public:
  explicit GrowingHull(std::vector<Vec3> points) : points_(std::move(points)) {
    grow();
  }

  // Not on its surface either.
  bool is_within(const Box3& box) const {
    if (planes_.empty()) return false;
    const auto is_below = [&](const HalfSpace& plane) {
      const Vec3 farthest(plane.normal.x > 0 ? box.high.x : box.low.x,
                          plane.normal.y > 0 ? box.high.y : box.low.y,
                          plane.normal.z > 0 ? box.high.z : box.low.z);
      return glm::dot(plane.normal, farthest) < plane.distance - kTieDistance;
    };
    return std::all_of(planes_.begin(), planes_.end(), is_below);
  }

  void add(const BoundaryFace& face) {
    for (const auto& contour : face.contours) {
      points_.insert(points_.end(), contour.begin(), contour.end());
    }
    if (points_.size() > 2 * kept_ + kFewPoints) grow();
  }

  std::vector<Vec3> take_points() { return std::move(points_); }

 private:
  struct HalfSpace {
    Vec3 normal;
    double distance = 0;  // from the origin
  };

  // So few that a hull costs nothing.
  static constexpr std::size_t kFewPoints = 200;

  void grow() {
    const Mesh hull = convex_hull(points_);
    if (!hull.triangles.empty()) points_ = hull.vertices;
    kept_ = points_.size();
    planes_.clear();
    for (const auto& [a, b, c] : hull.triangles) {
      const Vec3 corner = hull.vertices[a];
      const Vec3 across =
          glm::cross(hull.vertices[b] - corner, hull.vertices[c] - corner);
      const double length = glm::length(across);
      if (length == 0) continue;
      const Vec3 normal = across / length;
      planes_.push_back({normal, glm::dot(normal, corner)});
    }
  }

  std::vector<Vec3> points_;
  std::size_t kept_ = 0;  // how many they were after the last hull
  std::vector<HalfSpace> planes_;
};

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
  if (scene.instances.empty()) return convex_hull(std::move(points));
  GrowingHull hull(std::move(points));
  visit_boundary_faces(
      scene, [&](const Box3& box) { return !hull.is_within(box); },
      [&](const BoundaryFace& face) { hull.add(face); });
  return convex_hull(hull.take_points());
}

}  // namespace lamina::csg
