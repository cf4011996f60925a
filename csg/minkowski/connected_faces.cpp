#include "csg/minkowski/connected_faces.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "csg/boundary/leaf_box.h"

namespace lamina::csg {
namespace {

// A corner this near [mm] to a face lies on it: the tie distance of the sweep.
constexpr double kTouchDistance = 1e-6;

class Components {
 public:
  explicit Components(std::size_t count) : parents_(count) {
    std::iota(parents_.begin(), parents_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }
  void join(std::size_t i, std::size_t k) { parents_[find(k)] = find(i); }

 private:
  std::vector<std::size_t> parents_;
};

Box3 box_of(const Convex& face) {
  Box3 box;
  for (const Vec3& vertex : face.vertices) {
    box.low = glm::min(box.low, vertex);
    box.high = glm::max(box.high, vertex);
  }
  box.low -= kTouchDistance;
  box.high += kTouchDistance;
  return box;
}

bool lies_on(const Vec3& point, const Convex& face) {
  const Vec3& normal = face.normals[0];
  const std::vector<Vec3>& corners = face.vertices;
  if (std::abs(glm::dot(point - corners[0], normal)) > kTouchDistance) {
    return false;
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3& from = corners[i];
    const Vec3 side = corners[i + 1 == corners.size() ? 0 : i + 1] - from;
    const double inwards =
        glm::dot(glm::cross(normal, side), point - from) / glm::length(side);
    if (inwards < -kTouchDistance) return false;
  }
  return true;
}

bool touch(const Convex& a, const Convex& b) {
  const auto has_corner_on = [](const Convex& face, const Convex& other) {
    return std::any_of(face.vertices.begin(), face.vertices.end(),
                       [&](const Vec3& v) { return lies_on(v, other); });
  };
  return has_corner_on(a, b) || has_corner_on(b, a);
}

}  // namespace

std::vector<Vec3> points_of_components(std::span<const Convex> faces) {
  // Sweep a plane along x over the faces' boxes.
  std::vector<Box3> boxes;
  for (const Convex& face : faces) boxes.push_back(box_of(face));
  std::vector<std::size_t> order(faces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t k) {
    return boxes[i].low.x < boxes[k].low.x;
  });
  Components components(faces.size());
  std::vector<std::size_t> open;
  for (const std::size_t i : order) {
    std::erase_if(
        open, [&](std::size_t k) { return boxes[k].high.x < boxes[i].low.x; });
    for (const std::size_t k : open) {
      if (!intersect_boxes(boxes[i], boxes[k]).is_empty() &&
          components.find(i) != components.find(k) &&
          touch(faces[i], faces[k])) {
        components.join(i, k);
      }
    }
    open.push_back(i);
  }
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (components.find(i) == i) points.push_back(faces[i].vertices[0]);
  }
  return points;
}

}  // namespace lamina::csg
