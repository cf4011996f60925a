#include "csg/minkowski/boolean_faces.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "csg/boundary/box_tree.h"
#include "csg/plane/triangulate.h"
#include "csg/vertex_table.h"

namespace lamina::csg {
namespace {

// A corner this far [mm] above the plane of a face lies in it: above the
// distance at which edges of a region are one, a tenth of the tie distance of
// the sweep.
constexpr double kFlatDistance = 1e-7;

}  // namespace

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
    planar::Region region;
    std::vector<std::uint32_t> corners;
    for (const std::vector<Vec3>& contour : face.contours) {
      region.contours.emplace_back();
      for (const Vec3& p : contour) {
        region.contours.back().emplace_back(glm::dot(p, x_axis),
                                            glm::dot(p, y_axis));
        corners.push_back(names.name(p));
      }
    }
    for (const auto& t : planar::triangulate(region)) {
      mesh.triangles.push_back({corners[t[0]], corners[t[1]], corners[t[2]]});
    }
  }
  mesh.vertices = names.take_points();
  return mesh;
}

}  // namespace lamina::csg
