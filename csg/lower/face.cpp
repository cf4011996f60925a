#include "csg/lower/detail/face.h"

#include <algorithm>
#include <array>
#include <vector>

#include <glm/geometric.hpp>

#include "plane/loop_area.h"
#include "plane/predicates.h"
#include "plane/region/triangulate.h"

namespace lamina::csg {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

// Normal of the largest triangle over the polygon's longest extent. For a
// polygon that is not planar this is OpenSCAD's choice of its direction, in
// OpenSCAD's single precision and with the first vertex looked at last; for a
// planar one any direction would do.
glm::vec3 typical_normal(std::span<const Vec3> vertices,
                         std::span<const std::uint32_t> face) {
  std::vector<glm::vec3> points;
  for (std::size_t i = 1; i <= face.size(); ++i) {
    points.emplace_back(vertices[face[i % face.size()]]);
  }
  std::array<glm::vec3, 3> low;
  std::array<glm::vec3, 3> high;
  low.fill(points[0]);
  high.fill(points[0]);
  for (const glm::vec3& p : points) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      if (p[axis] < low[k][axis]) low[k] = p;
      if (p[axis] > high[k][axis]) high[k] = p;
    }
  }
  std::size_t longest = 0;
  const auto extent = [&](std::size_t k) {
    const int axis = static_cast<int>(k);
    return high[k][axis] - low[k][axis];
  };
  if (extent(1) > extent(longest)) longest = 1;
  if (extent(2) > extent(longest)) longest = 2;

  glm::vec3 best(0, 0, 1);
  float best_size = 0;
  for (const glm::vec3& p : points) {
    const glm::vec3 normal =
        glm::cross(low[longest] - high[longest], p - high[longest]);
    const float size = glm::dot(normal, normal);
    if (size > best_size) {
      best = normal;
      best_size = size;
    }
  }
  return best;
}

// The polygon on the coordinate plane that shows most of it (so the
// coordinates stay the vertices' own, not rounded again), counter-clockwise.
plane::Contour project(std::span<const Vec3> vertices,
                       std::span<const std::uint32_t> face) {
  const glm::vec3 size = glm::abs(typical_normal(vertices, face));
  int drop = size.y > size.x ? 1 : 0;
  if (size.z > size[drop]) drop = 2;
  plane::Contour contour;
  for (const std::uint32_t i : face) {
    contour.push_back(
        {vertices[i][(drop + 1) % 3], vertices[i][(drop + 2) % 3]});
  }
  if (sliver_area(contour) < 0) {
    for (Vec2& point : contour) point.y = -point.y;
  }
  return contour;
}

// Where both diagonals of a quad are equally good, as in a grid of squares,
// OpenSCAD's choice is that of a sweep from right to left in single precision:
// its first diagonal leaves the second vertex from the left.
std::vector<Triangle> split_quad(const plane::Contour& quad) {
  std::array<std::uint32_t, 4> order{0, 1, 2, 3};
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const glm::vec2 p(quad[a]);
    const glm::vec2 q(quad[b]);
    return p.x < q.x || (p.x == q.x && p.y < q.y);
  });
  const Vec2 left = quad[order[0]];
  const Vec2 right = quad[order[3]];
  const bool are_on_two_sides = orientation(left, right, quad[order[1]]) !=
                                orientation(left, right, quad[order[2]]);
  const std::uint32_t from = order[1];
  const std::uint32_t to = are_on_two_sides ? order[2] : order[3];
  std::vector<Triangle> halves{{from, (from + 1) % 4, (from + 2) % 4},
                               {from, (from + 2) % 4, (from + 3) % 4}};
  const bool is_diagonal = to == (from + 2) % 4;
  const bool is_inside =
      std::all_of(halves.begin(), halves.end(), [&](const Triangle& t) {
        return orientation(quad[t[0]], quad[t[1]], quad[t[2]]) > 0;
      });
  if (is_diagonal && is_inside) return halves;
  return plane::triangulate({{quad}});
}

}  // namespace

void add_face(Mesh& mesh, std::span<const std::uint32_t> face) {
  if (face.size() == 3) {
    mesh.triangles.push_back({face[0], face[1], face[2]});
    return;
  }
  const plane::Region shadow{{project(mesh.vertices, face)}};
  auto triangles = face.size() == 4 ? split_quad(shadow.contours[0])
                                    : plane::triangulate(shadow);
  plane::make_delaunay(shadow.contours[0], triangles);
  for (const Triangle& t : triangles) {
    mesh.triangles.push_back({face[t[0]], face[t[1]], face[t[2]]});
  }
}

}  // namespace lamina::csg
