// CGAL's Nef polyhedra judge the boundary faces of small Booleans: they find
// volume and area of the same solid in a way that shares nothing.

#include "csg/boundary/boundary_faces.h"

#include <cstddef>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "csg/boundary/leaf_mesh.h"
#include "tests/oracle/nef_solid.h"
#include "tests/oracle/world_scene.h"
#include "tests/support/design.h"

namespace lamina::oracle {
namespace {

struct Measures {
  double volume = 0;
  double area = 0;
};

Measures measure(const csg::Mesh& mesh) {
  Measures sum{csg::signed_volume(mesh), 0};
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]];
    sum.area += 0.5 * glm::length(glm::cross(mesh.vertices[t[1]] - a,
                                             mesh.vertices[t[2]] - a));
  }
  return sum;
}

Measures measure(const std::vector<csg::BoundaryFace>& faces) {
  Measures sum;
  for (const csg::BoundaryFace& face : faces) {
    Vec3 area(0);
    for (const auto& contour : face.contours) {
      for (std::size_t i = 2; i < contour.size(); ++i) {
        area += 0.5 * glm::cross(contour[i - 1] - contour[0],
                                 contour[i] - contour[0]);
      }
    }
    sum.volume += glm::dot(area, face.contours[0][0]) / 3;
    sum.area += glm::dot(area, face.normal);
  }
  return sum;
}

void expect_what_nef_finds(const std::string& design) {
  SCOPED_TRACE(design);
  const auto read = support::Design::from_text(design);
  const Measures nef = measure(nef_boundary(world_scene(read.scene())));
  const Measures faces = measure(csg::boundary_faces(read.scene()));
  EXPECT_GT(nef.volume, 0);
  EXPECT_NEAR(faces.volume, nef.volume, 1e-5);
  EXPECT_NEAR(faces.area, nef.area, 1e-5);
}

TEST(BoundaryFaces, EncloseWhatNefPolyhedraEnclose) {
  expect_what_nef_finds(
      "difference() { sphere(5, $fn = 12);"
      "  translate([3, 1, 2]) rotate([10, 20, 30]) cube(5); }");
  expect_what_nef_finds(
      "intersection() { union() { cube(6); translate([3, 3, 3]) cube(6); }"
      "  rotate([45, 0, 10]) cylinder(h = 12, r = 4, $fn = 9); }");
}

TEST(BoundaryFaces, EncloseWhatNefPolyhedraEncloseWhereFacesCoincide) {
  expect_what_nef_finds(
      "difference() { cube([6, 4, 2]); cube([2, 2, 2]);"
      "  translate([2, 0, 1]) cube([4, 2, 1]); }"
      "translate([6, 0, 0]) cube([2, 4, 2]);");
  expect_what_nef_finds(
      "difference() { cylinder(h = 4, r = 5, $fn = 8);"
      "  difference() { cylinder(h = 4, r = 4, $fn = 8);"
      "    translate([0, 0, 2]) cube([9, 9, 9]); } }");
}

}  // namespace
}  // namespace lamina::oracle
