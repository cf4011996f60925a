#include "csg/minkowski/detail/surfaces.h"

#include <cstdint>
#include <utility>

#include "csg/boundary/convex_hull.h"
#include "plane/region/convex_faces.h"

namespace lamina::csg::detail {
namespace {

std::vector<Vec3> without_twins(const std::vector<Vec3>& points) {
  const std::vector<std::uint32_t> names = join_near(points);
  std::vector<Vec3> first;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (names[i] == i) first.push_back(points[i]);
  }
  return first;
}

}  // namespace

Convex hull_of(const std::vector<Vec3>& points) {
  const Mesh hull = convex_hull(without_twins(points));
  std::vector<std::vector<std::uint32_t>> loops;
  for (plane::Face& face :
       plane::merge_to_convex(hull.vertices, hull.triangles)) {
    loops.push_back(std::move(face.corners));
  }
  Convex body = make_solid(hull.vertices, loops);
  body.is_hull = true;
  return body;
}

JoinedFaces join(Mesh mesh) {
  std::vector<std::vector<std::uint32_t>> loops;
  for (plane::Face& face :
       plane::merge_to_convex(mesh.vertices, mesh.triangles)) {
    loops.push_back(std::move(face.corners));
  }
  const std::vector<Vec3> normals = normals_of(mesh.vertices, loops);
  return {std::move(mesh.vertices), std::move(loops), normals};
}

}  // namespace lamina::csg::detail
