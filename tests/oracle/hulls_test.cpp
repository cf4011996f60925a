// CGAL judges hull() of designs large and small: it makes convex hulls of
// points that are known otherwise, by the formula or as the corners of a Nef
// polyhedron.

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "csg/boundary/leaf_mesh.h"
#include "tests/oracle/exact_hull.h"
#include "tests/oracle/nef_solid.h"
#include "tests/oracle/whole_solid.h"
#include "tests/oracle/world_scene.h"
#include "tests/support/design.h"

namespace lamina::oracle {
namespace {

using support::Design;

// The corners of OpenSCAD's sphere: rings at the middles of equal angles.
void add_sphere(Vec3 centre, double r, int facets, std::vector<Vec3>& points) {
  using std::numbers::pi;
  const int rings = (facets + 1) / 2;
  for (int i = 0; i < rings; ++i) {
    const double polar = pi * (i + 0.5) / rings;
    for (int k = 0; k < facets; ++k) {
      const double turn = 2 * pi * k / facets;
      points.push_back(centre + r * Vec3(std::sin(polar) * std::cos(turn),
                                         std::sin(polar) * std::sin(turn),
                                         std::cos(polar)));
    }
  }
}

// Along a spiral over an egg, sizes mixed: many of them touch the hull.
TEST(Hulls, OfTenThousandSpheresAreThoseOfTheirCorners) {
  const Design design = Design::from_text(
      "hull() for (i = [0 : 99], k = [0 : 99]) {"
      "  n = 100 * i + k;"
      "  u = 1 - 2 * (n + 0.5) / 10000;"
      "  s = 40 * sqrt(1 - u * u);"
      "  a = 2.4 * n * 180 / PI;"
      "  translate([s * cos(a), s * sin(a), 50 * u])"
      "    sphere(1 + 0.01 * (n % 7), $fn = 8);"
      "}");
  std::vector<Vec3> points;
  for (int n = 0; n < 10000; ++n) {
    const double u = 1 - 2 * (n + 0.5) / 10000;
    const double s = 40 * std::sqrt(1 - u * u);
    const double a = 2.4 * n;
    add_sphere({s * std::cos(a), s * std::sin(a), 50 * u}, 1 + 0.01 * (n % 7),
               8, points);
  }
  const csg::Mesh hull = exact_hull(points);
  EXPECT_GT(hull.vertices.size(), 2000U);
  EXPECT_EQ(compare_with_solid(design.scene(), hull), "");
}

// Of what the children leave: its corners are those of a Nef polyhedron.
void expect_hull_of_corners(const std::string& children) {
  const Design solid = Design::from_text(children);
  const csg::Mesh corners = nef_boundary(world_scene(solid.scene()));
  const csg::Mesh hull = exact_hull(corners.vertices);
  EXPECT_GT(csg::signed_volume(hull), csg::signed_volume(corners) + 0.01);
  const std::string text = "hull() { " + children + " }";
  EXPECT_EQ(compare_with_solid(Design::from_text(text).scene(), hull), "")
      << text;
}

TEST(Hulls, OfADifferenceAreThoseOfItsCorners) {
  expect_hull_of_corners(
      "difference() { sphere(5, $fn = 14); translate([3, 1, 2]) sphere(4.5, "
      "$fn ="
      " 12); }");
  expect_hull_of_corners(
      "difference() { cube([6, 4, 3]); translate([4, 2, 1]) rotate([20, 30, "
      "40])"
      " cube(9); }");
  expect_hull_of_corners(
      "difference() { cylinder(h = 6, r = 3, $fn = 9); translate([1, 0, 3])"
      " rotate([0, 80, 10]) cylinder(h = 9, r = 2, $fn = 7, center = true); }"
      "translate([9, 2, 1]) intersection() { cube(3); rotate([0, 0, 40])"
      " translate([0, 0, 1]) sphere(3, $fn = 8); }");
}

TEST(Hulls, OfADifferenceThatLeavesPiecesAreThoseOfAllPieces) {
  expect_hull_of_corners(
      "difference() { rotate([10, 20, 30]) cube([9, 3, 2], center = true);"
      " cube([4, 9, 9], center = true); }");
}

}  // namespace
}  // namespace lamina::oracle
