#include "tests/oracle/surface_distance.h"

#include <array>
#include <cstddef>
#include <vector>

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

}  // namespace lamina::oracle
