#include "csg/minkowski/connected_faces.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>

#include <glm/geometric.hpp>

#include "csg/boundary/box_tree.h"

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

struct Face {
  std::vector<Vec3> corners;
  Vec3 normal;
};

Vec3 nearest_on_edge(const JoinedFaces& surface, std::size_t edge,
                     const Vec3& aim) {
  const JoinedFaces::Edge ends = surface.edges()[edge];
  const Vec3 from = surface.vertices()[ends.from];
  const Vec3 along = surface.vertices()[ends.to] - from;
  const double share = glm::dot(aim - from, along) / glm::dot(along, along);
  return from + std::clamp(share, 0.0, 1.0) * along;
}

Box3 box_of(const Face& face) {
  Box3 box;
  box.add(face.corners);
  box.low -= kTouchDistance;
  box.high += kTouchDistance;
  return box;
}

bool lies_on(const Vec3& point, const Face& face) {
  const std::vector<Vec3>& corners = face.corners;
  if (std::abs(glm::dot(point - corners[0], face.normal)) > kTouchDistance) {
    return false;
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3& from = corners[i];
    const Vec3 side = corners[i + 1 == corners.size() ? 0 : i + 1] - from;
    const double inwards =
        glm::dot(glm::cross(face.normal, side), point - from) /
        glm::length(side);
    if (inwards < -kTouchDistance) return false;
  }
  return true;
}

bool touch(const Face& a, const Face& b) {
  const auto has_corner_on = [](const Face& face, const Face& other) {
    return std::any_of(face.corners.begin(), face.corners.end(),
                       [&](const Vec3& v) { return lies_on(v, other); });
  };
  return has_corner_on(a, b) || has_corner_on(b, a);
}

}  // namespace

std::vector<Vec3> points_of_components(const JoinedFaces& surface,
                                       const Vec3& aim) {
  std::vector<Face> faces;
  std::vector<Box3> boxes;
  for (std::size_t f = 0; f < surface.face_count(); ++f) {
    faces.push_back({surface.polygon(f), surface.normals()[f]});
    boxes.push_back(box_of(faces.back()));
  }
  Components components(faces.size());
  for (std::size_t e = 0; e < surface.edges().size(); ++e) {
    for (const JoinedFaces::EdgeFace& other : surface.faces_at(e)) {
      components.join(surface.faces_at(e)[0].face, other.face);
    }
  }

  // Sweep a plane along x over the faces' boxes.
  std::vector<std::size_t> order(faces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t k) {
    return boxes[i].low.x < boxes[k].low.x;
  });
  std::vector<std::size_t> open;
  for (const std::size_t i : order) {
    std::erase_if(
        open, [&](std::size_t k) { return boxes[k].high.x < boxes[i].low.x; });
    for (const std::size_t k : open) {
      if (do_meet(boxes[i], boxes[k]) &&
          components.find(i) != components.find(k) &&
          touch(faces[i], faces[k])) {
        components.join(i, k);
      }
    }
    open.push_back(i);
  }

  std::vector<std::optional<Vec3>> nearest(faces.size());
  for (std::size_t e = 0; e < surface.edges().size(); ++e) {
    const auto at = surface.faces_at(e);
    if (at.empty()) continue;
    std::optional<Vec3>& best = nearest[components.find(at[0].face)];
    const Vec3 point = nearest_on_edge(surface, e, aim);
    if (!best || glm::distance(point, aim) < glm::distance(*best, aim)) {
      best = point;
    }
  }
  std::vector<Vec3> points;
  for (const std::optional<Vec3>& point : nearest) {
    if (point) points.push_back(*point);
  }
  return points;
}

}  // namespace lamina::csg
