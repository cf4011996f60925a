#include "csg/boundary/near_hull.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/geometric.hpp>

#include "csg/boundary/convex_hull.h"
#include "csg/plane/convex_faces.h"
#include "csg/vertex_table.h"

namespace lamina::csg {
namespace {

using Triangle = std::array<Vec3, 3>;

// Of a facet; the hull lies below it.
struct Plane {
  Vec3 normal = Vec3(0);
  Vec3 point = Vec3(0);

  bool is_near(const Triangle& triangle, double depth) const {
    return std::all_of(triangle.begin(), triangle.end(),
                       [&](const Vec3& corner) {
                         return glm::dot(normal, point - corner) <= depth;
                       });
  }
};

// The facets of a hull by their corners.
class HullFacets {
 public:
  explicit HullFacets(const Mesh& hull)
      : names_(hull.vertices.size()), planes_(hull.vertices.size()) {
    for (const Vec3& vertex : hull.vertices) names_.name(vertex);
    for (const planar::Face& face :
         planar::merge_to_convex(hull.vertices, hull.triangles)) {
      for (const std::uint32_t corner : face.corners) {
        planes_[corner].push_back({face.normal, hull.vertices[corner]});
      }
    }
  }

  std::vector<Plane> at(const Triangle& triangle) const {
    std::vector<Plane> planes;
    for (const Vec3& corner : triangle) {
      const auto name = names_.find(corner);
      if (!name) continue;
      planes.insert(planes.end(), planes_[*name].begin(), planes_[*name].end());
    }
    return planes;
  }

 private:
  VertexTable names_;
  std::vector<std::vector<Plane>> planes_;
};

// Whether each point of the triangle has one of the planes near. What one plane
// has not is cut into quarters.
bool is_near(std::span<const Plane> planes, const Triangle& triangle,
             double depth, int most_cuts) {
  const bool has_plane = std::any_of(
      planes.begin(), planes.end(),
      [&](const Plane& plane) { return plane.is_near(triangle, depth); });
  if (has_plane || most_cuts == 0) return has_plane;
  const auto& [a, b, c] = triangle;
  const Vec3 ab = (a + b) / 2.0;
  const Vec3 bc = (b + c) / 2.0;
  const Vec3 ca = (c + a) / 2.0;
  const std::array<Triangle, 4> quarters = {
      {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}};
  return std::all_of(quarters.begin(), quarters.end(),
                     [&](const Triangle& quarter) {
                       return is_near(planes, quarter, depth, most_cuts - 1);
                     });
}

}  // namespace

std::optional<Mesh> near_hull(const Mesh& mesh, double depth) {
  constexpr int kMostCuts = 3;
  Mesh hull = convex_hull(mesh.vertices);
  if (hull.triangles.empty()) return std::nullopt;
  const HullFacets facets(hull);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Triangle triangle = {mesh.vertices[a], mesh.vertices[b],
                               mesh.vertices[c]};
    if (!is_near(facets.at(triangle), triangle, depth, kMostCuts)) {
      return std::nullopt;
    }
  }
  return hull;
}

}  // namespace lamina::csg
