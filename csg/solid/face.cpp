#include "csg/solid/detail/face.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "csg/planar/triangulate.h"

namespace lamina::csg {
namespace {

// Newell's normal: twice the area of the polygon's shadows on the three
// coordinate planes. Defined for any polygon, plane or not.
Vec3 newell_normal(std::span<const Vec3> vertices,
                   std::span<const std::uint32_t> face) {
  Vec3 sum(0);
  const Vec3 origin = vertices[face[0]];
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Vec3 a = vertices[face[i]] - origin;
    const Vec3 b = vertices[face[(i + 1) % face.size()]] - origin;
    sum += glm::cross(a, b);
  }
  return sum;
}

// The polygon seen against its normal, counter-clockwise.
planar::Contour project(std::span<const Vec3> vertices,
                        std::span<const std::uint32_t> face) {
  const Vec3 normal = newell_normal(vertices, face);
  const Vec3 size = glm::abs(normal);
  // Leave out the coordinate along which the face is seen best; what is left
  // are the vertices' own coordinates, not rounded again.
  int drop = size.y > size.x ? 1 : 0;
  if (size.z > size[drop]) drop = 2;
  int u = (drop + 1) % 3;
  int v = (drop + 2) % 3;
  if (normal[drop] < 0) std::swap(u, v);
  planar::Contour contour;
  for (const std::uint32_t i : face) {
    contour.push_back({vertices[i][u], vertices[i][v]});
  }
  return contour;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate_face(
    std::span<const Vec3> vertices, std::span<const std::uint32_t> face) {
  if (face.size() == 3) return {{face[0], face[1], face[2]}};
  const planar::Region shadow{{project(vertices, face)}};
  auto triangles = planar::triangulate(shadow);
  planar::make_delaunay(shadow.contours[0], triangles);
  for (auto& t : triangles) {
    for (std::uint32_t& corner : t) corner = face[corner];
  }
  return triangles;
}

}  // namespace lamina::csg
