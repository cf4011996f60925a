#include "tests/oracle/exact_hull.h"

#include <cstdint>
#include <stdexcept>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

namespace lamina::oracle {
namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

Point point_of(const Vec3& p) { return {p.x, p.y, p.z}; }

}  // namespace

csg::Mesh exact_hull(std::span<const Vec3> points) {
  using Surface = CGAL::Surface_mesh<Point>;
  std::vector<Point> given;
  for (const Vec3& p : points) given.push_back(point_of(p));
  Surface hull;
  CGAL::convex_hull_3(given.begin(), given.end(), hull);
  if (hull.number_of_faces() < 4) {
    throw std::runtime_error("the points span no volume");
  }

  csg::Mesh mesh;
  for (const Surface::Vertex_index v : hull.vertices()) {
    const Point& p = hull.point(v);
    mesh.vertices.emplace_back(p.x(), p.y(), p.z());
  }
  for (const Surface::Face_index f : hull.faces()) {
    std::vector<std::uint32_t> corners;
    for (const auto v : hull.vertices_around_face(hull.halfedge(f))) {
      corners.push_back(static_cast<std::uint32_t>(v));
    }
    for (std::size_t i = 2; i < corners.size(); ++i) {
      mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
    }
  }
  return mesh;
}

int exact_orientation(const Vec3& a, const Vec3& b, const Vec3& c,
                      const Vec3& d) {
  return CGAL::orientation(point_of(a), point_of(b), point_of(c), point_of(d));
}

}  // namespace lamina::oracle
