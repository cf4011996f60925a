#include "tests/oracle/surface_distance.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Kernel/global_functions.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

namespace lamina::oracle {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
namespace processing = CGAL::Polygon_mesh_processing;

Surface to_surface(const csg::Mesh& mesh) {
  std::vector<Kernel::Point_3> points;
  for (const Vec3& p : mesh.vertices) points.emplace_back(p.x, p.y, p.z);
  std::vector<std::array<std::size_t, 3>> triangles;
  for (const auto& t : mesh.triangles) {
    if (CGAL::collinear(points[t[0]], points[t[1]], points[t[2]])) continue;
    triangles.push_back({t[0], t[1], t[2]});
  }
  // Cuts the soup where it is no manifold.
  processing::orient_polygon_soup(points, triangles);
  Surface surface;
  processing::polygon_soup_to_polygon_mesh(points, triangles, surface);
  return surface;
}

}  // namespace

double surface_distance(const csg::Mesh& from, const csg::Mesh& to,
                        double error) {
  return processing::bounded_error_Hausdorff_distance<CGAL::Sequential_tag>(
      to_surface(from), to_surface(to), error);
}

std::vector<double> distances_from(const csg::Mesh& surface,
                                   const std::vector<Vec3>& places) {
  using Primitive = CGAL::AABB_face_graph_triangle_primitive<Surface>;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
  const Surface faces = to_surface(surface);
  Tree tree(CGAL::faces(faces).begin(), CGAL::faces(faces).end(), faces);
  tree.accelerate_distance_queries();
  std::vector<double> distances;
  distances.reserve(places.size());
  for (const Vec3& p : places) {
    distances.push_back(
        std::sqrt(tree.squared_distance(Kernel::Point_3(p.x, p.y, p.z))));
  }
  return distances;
}

}  // namespace lamina::oracle
