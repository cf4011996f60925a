#include "csg/minkowski/joined_faces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "csg/mesh/box_tree.h"
#include "csg/mesh/edge_table.h"
#include "csg/mesh/vertex_table.h"
#include "plane/region/triangulate.h"

namespace lamina::csg {
namespace {

// Vertices this near to each other [mm] are one: above the distance at which
// edges of a region are one, a tenth of the tie distance of the sweep.
constexpr double kJoinDistance = 1e-7;

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

// A corner this far [mm] above the plane of a face lies in it: above the
// distance at which edges of a region are one, a tenth of the tie distance of
// the sweep.
constexpr double kFlatDistance = 1e-7;

}  // namespace

std::vector<std::uint32_t> join_near(std::span<const Vec3> points) {
  // Near points are near along any direction; along this one, few others are.
  const Vec3 direction = glm::normalize(Vec3(0.5772156649, 0.6931471806, 0.4));
  std::vector<std::pair<double, std::uint32_t>> order;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    order.emplace_back(glm::dot(points[i], direction), i);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> names(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto [place, point] = order[i];
    names[point] = point;
    for (std::size_t k = i; k-- > 0;) {
      const auto [other_place, other] = order[k];
      if (place - other_place > kJoinDistance) break;
      if (glm::distance(points[point], points[other]) > kJoinDistance) continue;
      names[point] = names[other];
      break;
    }
  }
  return names;
}

JoinedFaces::JoinedFaces(std::vector<Vec3> vertices,
                         std::vector<std::vector<std::uint32_t>> loops,
                         std::span<const Vec3> normals) {
  const std::vector<std::uint32_t> names = join_near(vertices);
  for (std::size_t f = 0; f < loops.size(); ++f) {
    std::vector<std::uint32_t>& loop = loops[f];
    for (std::uint32_t& corner : loop) corner = names[corner];
    loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
    while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    if (loop.size() > 2 && normals[f] != Vec3(0)) add_face(loop, normals[f]);
  }
  vertices_ = std::move(vertices);
  std::span faces(&corners_, 1);
  keep_named_points(vertices_, faces);
  join_faces();
  list_edges_of_vertices();
}

JoinedFaces::JoinedFaces(const Convex& body) : vertices_(body.vertices) {
  const std::size_t count = body.is_flat ? 1 : body.facet_count();
  for (std::size_t f = 0; f < count; ++f) {
    const auto loop = body.facet(f);
    if (loop.size() < 3) continue;
    add_face(loop, body.normals[f]);
  }
  join_faces();
  if (vertices_.size() == 2) {
    edges_.push_back({0, 1});
    edge_ends_.push_back(0);
  }
  list_edges_of_vertices();
}

void JoinedFaces::add_face(std::span<const std::uint32_t> loop, Vec3 normal) {
  corners_.insert(corners_.end(), loop.begin(), loop.end());
  face_ends_.push_back(static_cast<std::uint32_t>(corners_.size()));
  normals_.push_back(normal);
}

void JoinedFaces::join_faces() {
  const auto table = EdgeTable::make(vertices_.size(), [this](auto visit) {
    for (std::uint32_t f = 0; f < face_count(); ++f) {
      const auto loop = corners_of(f);
      for (std::size_t i = 0; i < loop.size(); ++i) {
        visit(f, loop[i], loop[i + 1 == loop.size() ? 0 : i + 1]);
      }
    }
  });
  sides_.resize(corners_.size());
  table.for_each_edge([&](std::uint32_t low, auto sides) {
    const auto edge = static_cast<std::uint32_t>(edges_.size());
    edges_.push_back({low, sides[0].high});
    for (const csg::Side& side : sides) {
      edge_faces_.push_back({side.face(), side.is_rising()});
      const std::uint32_t start = side.is_rising() ? low : side.high;
      const std::uint32_t end = side.is_rising() ? side.high : low;
      const auto loop = corners_of(side.face());
      const std::size_t begin = face_ends_[side.face()] - loop.size();
      for (std::size_t i = 0; i < loop.size(); ++i) {
        if (loop[i] == start && loop[i + 1 == loop.size() ? 0 : i + 1] == end) {
          sides_[begin + i] = {edge, side.is_rising()};
        }
      }
    }
    edge_ends_.push_back(static_cast<std::uint32_t>(edge_faces_.size()));
  });
}

void JoinedFaces::list_edges_of_vertices() {
  vertex_ends_.assign(vertices_.size() + 1, 0);
  for (const Edge& edge : edges_) {
    ++vertex_ends_[edge.from];
    ++vertex_ends_[edge.to];
  }
  // Fill from the ends; this makes of each end the beginning.
  std::uint32_t end = 0;
  for (std::uint32_t& count : vertex_ends_) count = end += count;
  vertex_edges_.resize(end);
  for (std::uint32_t e = 0; e < edges_.size(); ++e) {
    vertex_edges_[--vertex_ends_[edges_[e].from]] = e;
    vertex_edges_[--vertex_ends_[edges_[e].to]] = e;
  }
  vertex_ends_.erase(vertex_ends_.begin());
}

std::vector<Vec3> JoinedFaces::polygon(std::size_t face) const {
  std::vector<Vec3> points;
  for (const std::uint32_t corner : corners_of(face)) {
    points.push_back(vertices_[corner]);
  }
  return points;
}

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

std::vector<Vec3> corners_of(std::span<const BoundaryFace> faces) {
  std::vector<Vec3> corners;
  for (const BoundaryFace& face : faces) {
    for (const std::vector<Vec3>& contour : face.contours) {
      corners.insert(corners.end(), contour.begin(), contour.end());
    }
  }
  return corners;
}

bool is_convex(std::span<const BoundaryFace> faces) {
  std::vector<Box3> corners;
  for (const Vec3& corner : corners_of(faces)) {
    corners.push_back({corner, corner});
  }
  const BoxTree tree(corners);
  return std::all_of(faces.begin(), faces.end(), [&](const BoundaryFace& face) {
    const double height = glm::dot(face.normal, face.contours[0][0]);
    bool is_passed = false;
    tree.visit(
        [&](const Box3& box) {
          const double reach =
              glm::dot(face.normal, box.low + box.high) +
              glm::dot(glm::abs(face.normal), box.high - box.low);
          return !is_passed && reach / 2 > height + kFlatDistance;
        },
        [&](std::uint32_t) { is_passed = true; });
    return !is_passed;
  });
}

Mesh triangulate(std::span<const BoundaryFace> faces) {
  Mesh mesh;
  VertexTable names;
  for (const BoundaryFace& face : faces) {
    // A plane that turns the face's normal to the viewer.
    const Vec3 n = face.normal;
    const Vec3 other = std::abs(n.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    const Vec3 x_axis = glm::normalize(glm::cross(other, n));
    const Vec3 y_axis = glm::cross(n, x_axis);
    plane::Region region;
    std::vector<std::uint32_t> corners;
    for (const std::vector<Vec3>& contour : face.contours) {
      region.contours.emplace_back();
      for (const Vec3& p : contour) {
        region.contours.back().emplace_back(glm::dot(p, x_axis),
                                            glm::dot(p, y_axis));
        corners.push_back(names.name(p));
      }
    }
    for (const auto& t : plane::triangulate(region)) {
      mesh.triangles.push_back({corners[t[0]], corners[t[1]], corners[t[2]]});
    }
  }
  mesh.vertices = names.take_points();
  return mesh;
}

}  // namespace lamina::csg
