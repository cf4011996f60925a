#include "csg/boundary/near_hull.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "csg/boundary/convex_hull.h"
#include "csg/mesh/box_tree.h"
#include "csg/mesh/vertex_table.h"
#include "plane/region/convex_faces.h"

namespace lamina::csg {
namespace {

using Triangle = std::array<Vec3, 3>;

// Of a facet; the hull lies below it.
struct HullPlane {
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
  HullFacets(const Mesh& hull, std::span<const plane::Face> faces)
      : names_(hull.vertices.size()), planes_(hull.vertices.size()) {
    for (const Vec3& vertex : hull.vertices) names_.name(vertex);
    for (const plane::Face& face : faces) {
      for (const std::uint32_t corner : face.corners) {
        planes_[corner].push_back({face.normal, hull.vertices[corner]});
      }
    }
  }

  std::vector<HullPlane> at(const Triangle& triangle) const {
    std::vector<HullPlane> planes;
    for (const Vec3& corner : triangle) {
      const auto name = names_.find(corner);
      if (!name) continue;
      planes.insert(planes.end(), planes_[*name].begin(), planes_[*name].end());
    }
    return planes;
  }

 private:
  VertexTable names_;
  std::vector<std::vector<HullPlane>> planes_;
};

// Whether each point of the triangle has one of the planes near. What one plane
// has not is cut into quarters.
bool is_near(std::span<const HullPlane> planes, const Triangle& triangle,
             double depth, int most_cuts) {
  const bool has_plane = std::any_of(
      planes.begin(), planes.end(),
      [&](const HullPlane& plane) { return plane.is_near(triangle, depth); });
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

bool lies_near(const Mesh& mesh, const HullFacets& facets, double depth) {
  constexpr int kMostCuts = 3;
  return std::all_of(
      mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& corners) {
        const auto& [a, b, c] = corners;
        const Triangle triangle = {mesh.vertices[a], mesh.vertices[b],
                                   mesh.vertices[c]};
        return is_near(facets.at(triangle), triangle, depth, kMostCuts);
      });
}

// --- What the mesh covers of its hull ----------------------------------------

using Polygon = std::vector<Vec3>;

Polygon corners_of(const Mesh& mesh, const plane::Face& face) {
  Polygon corners;
  for (const std::uint32_t i : face.corners) {
    corners.push_back(mesh.vertices[i]);
  }
  return corners;
}

// Where it is positive a point is outside.
struct Bound {
  Vec3 normal = Vec3(0);
  Vec3 point = Vec3(0);
  double least = 0;

  double at(const Vec3& p) const { return glm::dot(normal, p - point) - least; }
};

// What lies within the bound, and what outside. Nothing lies outside by no more
// than rounding.
std::pair<Polygon, Polygon> split(const Polygon& polygon, const Bound& bound) {
  constexpr double kSlack = 1e-9;  // [mm]; above what rounding makes
  if (std::all_of(polygon.begin(), polygon.end(), [&](const Vec3& corner) {
        return bound.at(corner) <= kSlack;
      })) {
    return {polygon, {}};
  }
  std::pair<Polygon, Polygon> parts;
  auto& [inside, outside] = parts;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 a = polygon[i];
    const Vec3 b = polygon[(i + 1) % polygon.size()];
    const double at_a = bound.at(a);
    const double at_b = bound.at(b);
    (at_a > 0 ? outside : inside).push_back(a);
    if ((at_a > 0) == (at_b > 0)) continue;
    const Vec3 crossing = a + (b - a) * (at_a / (at_a - at_b));
    inside.push_back(crossing);
    outside.push_back(crossing);
  }
  if (inside.size() < 3) inside.clear();
  return parts;
}

// The points that lie above the face, seen along a normal, and no farther from
// its plane than the depth.
std::vector<Bound> bounds_above(const Polygon& face, const Vec3& face_normal,
                                const Vec3& normal, double depth) {
  std::vector<Bound> bounds = {{face_normal, face[0], depth}};
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Vec3 a = face[i];
    const Vec3 across = glm::cross(face[(i + 1) % face.size()] - a, normal);
    const double length = glm::length(across);
    if (length > 0) bounds.push_back({across / length, a, 0});
  }
  return bounds;
}

// Leaves of the pieces what lies outside one of the bounds.
void take_away(std::span<const Bound> bounds, std::vector<Polygon>& pieces) {
  std::vector<Polygon> left;
  for (Polygon& piece : pieces) {
    std::vector<Polygon> outer;
    Polygon rest = piece;
    for (const Bound& bound : bounds) {
      auto [inside, outside] = split(rest, bound);
      rest = std::move(inside);
      if (!outside.empty()) outer.push_back(std::move(outside));
      if (rest.empty()) break;
    }
    if (rest.empty()) {
      left.push_back(std::move(piece));
    } else {
      std::move(outer.begin(), outer.end(), std::back_inserter(left));
    }
  }
  pieces = std::move(left);
}

// Whether below each point of the hull, straight down from its facet, a face of
// the mesh lies so near and faces about the same side. A sheet's need not: all
// of it lies near the facets of its hull, but it does not fill them.
bool covers(const Mesh& mesh, const Mesh& hull,
            std::span<const plane::Face> facets, double depth) {
  // Steep faces end before what is near their plane. Facets of a round solid
  // lean by less against each other, however few there are.
  constexpr double kLeastCosine = 0.5;
  const std::vector<plane::Face> faces =
      plane::merge_to_convex(mesh.vertices, mesh.triangles);
  std::vector<Polygon> polygons;
  std::vector<Box3> boxes;
  for (const plane::Face& face : faces) {
    polygons.push_back(corners_of(mesh, face));
    boxes.emplace_back().add(polygons.back());
  }
  const BoxTree tree(boxes);
  return std::all_of(facets.begin(), facets.end(), [&](const auto& facet) {
    std::vector<Polygon> bare = {corners_of(hull, facet)};
    Box3 box;
    box.add(bare[0]);
    box.low -= Vec3(depth / kLeastCosine);
    box.high += Vec3(depth / kLeastCosine);
    tree.visit(
        [&](const Box3& other) { return !bare.empty() && do_meet(box, other); },
        [&](std::uint32_t i) {
          if (glm::dot(facet.normal, faces[i].normal) < kLeastCosine) {
            return;
          }
          take_away(
              bounds_above(polygons[i], faces[i].normal, facet.normal, depth),
              bare);
        });
    return bare.empty();
  });
}

}  // namespace

std::optional<Mesh> near_hull(const Mesh& mesh, double depth) {
  Mesh hull = convex_hull(mesh.vertices);
  if (hull.triangles.empty()) return std::nullopt;
  std::vector<plane::Face> facets =
      plane::merge_to_convex(hull.vertices, hull.triangles);
  std::erase_if(facets,
                [](const auto& facet) { return facet.normal == Vec3(0); });
  if (!lies_near(mesh, HullFacets(hull, facets), depth) ||
      !covers(mesh, hull, facets, depth)) {
    return std::nullopt;
  }
  return hull;
}

}  // namespace lamina::csg
