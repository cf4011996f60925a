#include "csg/minkowski/joined_faces.h"

#include <algorithm>
#include <utility>

#include <glm/geometric.hpp>

#include "csg/edge_table.h"
#include "csg/vertex_table.h"

namespace lamina::csg {

namespace {

// Vertices this near to each other [mm] are one: above the distance at which
// edges of a region are one, a tenth of the tie distance of the sweep.
constexpr double kJoinDistance = 1e-7;

// For each point the first of a cluster of near ones.
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

}  // namespace

JoinedFaces::JoinedFaces(std::vector<Vec3> vertices,
                         std::vector<std::vector<std::uint32_t>> loops,
                         std::span<const Vec3> normals) {
  const std::vector<std::uint32_t> names = join_near(vertices);
  for (std::size_t f = 0; f < loops.size(); ++f) {
    std::vector<std::uint32_t>& loop = loops[f];
    for (std::uint32_t& corner : loop) corner = names[corner];
    loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
    while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    if (loop.size() > 2) add_face(loop, normals[f]);
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

}  // namespace lamina::csg
