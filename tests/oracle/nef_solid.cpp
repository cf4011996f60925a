#include "tests/oracle/nef_solid.h"

#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/convert_nef_polyhedron_to_polygon_mesh.h>

#include "tests/oracle/nef_polyhedron.h"

namespace lamina::oracle {
namespace {

using Point = NefKernel::Point_3;
using Polyhedron = CGAL::Polyhedron_3<NefKernel>;

Nef nef_of(const csg::Mesh& mesh) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  std::vector<Point> points;
  for (const Vec3& v : mesh.vertices) points.emplace_back(v.x, v.y, v.z);
  std::vector<std::vector<std::size_t>> triangles;
  for (const auto& t : mesh.triangles) triangles.push_back({t[0], t[1], t[2]});
  Polyhedron polyhedron;
  pmp::orient_polygon_soup(points, triangles);
  pmp::polygon_soup_to_polygon_mesh(points, triangles, polyhedron);
  if (!polyhedron.is_closed()) {
    throw std::runtime_error("a leaf is not closed");
  }
  if (!pmp::is_outward_oriented(polyhedron)) {
    pmp::reverse_face_orientations(polyhedron);
  }
  return Nef(polyhedron);
}

// The open set of no points would leave boundaries behind: regularise.
Nef evaluate(plane::BooleanOp op, const std::optional<Nef>& minuend,
             const std::vector<Nef>& others) {
  Nef result(Nef::EMPTY);
  if (op == plane::BooleanOp::kDifference) {
    if (minuend) result = *minuend;
    for (const Nef& other : others) result -= other;
  } else {
    std::vector<Nef> all = others;
    if (minuend) all.push_back(*minuend);
    if (!all.empty()) result = all.front();
    for (const Nef& each : all) {
      if (op == plane::BooleanOp::kUnion) {
        result += each;
      } else {
        result *= each;
      }
    }
  }
  return result.regularization();
}

}  // namespace

Nef nef_of(const WorldScene& scene) {
  std::vector<std::optional<Nef>> minuends(scene.program.size());
  std::vector<std::vector<Nef>> others(scene.program.size());
  const auto hand = [&](std::size_t parent, bool is_minuend, Nef nef) {
    if (is_minuend) {
      minuends[parent] = std::move(nef);
    } else {
      others[parent].push_back(std::move(nef));
    }
  };
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    hand(scene.parent[i], scene.is_minuend[i], nef_of(scene.meshes[i]));
  }
  // Children stand behind their parents.
  for (std::size_t n = scene.program.size(); n-- > 1;) {
    const plane::BooleanNode& node = scene.program[n];
    hand(node.parent, node.is_minuend,
         evaluate(node.op, minuends[n], others[n]));
  }
  return evaluate(scene.program[0].op, minuends[0], others[0]);
}

csg::Mesh mesh_of(const Nef& nef) {
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> polygons;
  CGAL::convert_nef_polyhedron_to_polygon_soup(nef, points, polygons, true);
  csg::Mesh mesh;
  for (const Point& p : points) {
    mesh.vertices.push_back({CGAL::to_double(p.x()), CGAL::to_double(p.y()),
                             CGAL::to_double(p.z())});
  }
  for (const auto& polygon : polygons) {
    mesh.triangles.push_back({static_cast<std::uint32_t>(polygon[0]),
                              static_cast<std::uint32_t>(polygon[1]),
                              static_cast<std::uint32_t>(polygon[2])});
  }
  return mesh;
}

csg::Mesh nef_boundary(const WorldScene& scene) {
  return mesh_of(nef_of(scene));
}

}  // namespace lamina::oracle
