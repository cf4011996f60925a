// Layers of designs against closed formulas, through the whole library.

#include "tests/support/formulas.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/contour_checks.h"
#include "tests/support/design.h"

namespace lamina {
namespace {

using plane::Contours;
using std::numbers::pi;
using support::Design;
using support::LoopCounts;

// The section of `text` at height z, checked for soundness.
Contours section(const std::string& text, double z) {
  const Design design = Design::from_text(text);
  const auto layers = support::slice_heights(design.scene(), {z});
  EXPECT_TRUE(support::are_sound(layers.at(0).contours)) << text;
  return layers.at(0).contours;
}

using support::polygon_area;

double polygon_perimeter(int facets, double radius) {
  return 2 * facets * radius * std::sin(pi / facets);
}

// Calls `visit` for the vertices and the middles of the edges.
void visit_points(const Contours& contours,
                  const std::function<void(Vec2)>& visit) {
  for (std::size_t l = 0; l < contours.loop_count(); ++l) {
    const auto loop = contours.loop(l);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      visit(loop[i]);
      visit((loop[i] + loop[(i + 1) % loop.size()]) * 0.5);
    }
  }
}

TEST(Formulas, ACubeIsASquareOfFourPoints) {
  const Contours contours = section("cube([4, 3, 2]);", 0.7);
  ASSERT_EQ(contours.loop_count(), 1U);
  EXPECT_EQ(contours.points.size(), 4U);
  EXPECT_DOUBLE_EQ(support::total_area(contours), 12);
  EXPECT_DOUBLE_EQ(support::total_perimeter(contours), 14);
}

TEST(Formulas, ACylinderIsARegularPolygon) {
  for (const int facets : {3, 4, 5, 8, 30, 100, 1000}) {
    const Contours contours = section(
        "cylinder(r = 5, h = 2, $fn = " + std::to_string(facets) + ");", 0.7);
    EXPECT_EQ(contours.points.size(), static_cast<std::size_t>(facets));
    EXPECT_NEAR(support::total_area(contours), polygon_area(facets, 5), 1e-11);
    EXPECT_NEAR(support::total_perimeter(contours),
                polygon_perimeter(facets, 5), 1e-11);
  }
}

TEST(Formulas, AConeShrinksLinearly) {
  const std::string cone = "cylinder(r1 = 5, r2 = 1, h = 8, $fn = 36);";
  const std::string apex = "cylinder(r1 = 0, r2 = 5, h = 10, $fn = 36);";
  for (const double z : {0.1, 1.37, 4.0, 7.9}) {
    EXPECT_NEAR(support::total_area(section(cone, z)),
                polygon_area(36, 5 - z / 2), 1e-11);
    EXPECT_NEAR(support::total_area(section(apex, z)), polygon_area(36, z / 2),
                1e-11);
  }
}

// Vertices lie on the sphere; a facet spans 360°/n around the axis and as much
// along a meridian, so it comes at most this far inside.
TEST(Formulas, ASphereStaysWithinItsChordalError) {
  for (const int facets : {24, 61, 200}) {
    const std::string text =
        "sphere(r = 5, $fn = " + std::to_string(facets) + ");";
    const double step = std::cos(pi / facets);
    for (const double z : {-4.63, -2.2, 0.05, 1.91, 4.2}) {
      const Contours contours = section(text, z);
      ASSERT_EQ(contours.loop_count(), 1U);
      visit_points(contours, [&](Vec2 p) {
        const double distance = std::hypot(p.x, p.y, z);
        EXPECT_LE(distance, 5 + 1e-12);
        EXPECT_GE(distance, 5 * step * step - 1e-12);
      });
    }
  }
}

TEST(Formulas, ATorusStaysWithinItsChordalError) {
  const std::string text =
      "rotate_extrude($fn = 90) translate([6, 0]) circle(r = 2, $fn = 60);";
  for (const double z : {-1.9, -0.3, 0.01, 1.2}) {
    const Contours contours = section(text, z);
    EXPECT_EQ(support::count_loops(contours), (LoopCounts{1, 1}));
    visit_points(contours, [&](Vec2 p) {
      const double distance = std::hypot(std::hypot(p.x, p.y) - 6, z);
      EXPECT_LE(std::abs(distance - 2),
                8 * (1 - std::cos(pi / 90)) + 2 * (1 - std::cos(pi / 60)));
    });
  }
}

TEST(Formulas, AnExtrudedPolygonKeepsItsArea) {
  const std::string polygon =
      "polygon(points = [[0, 0], [10, 0], [10, 8], [0, 8], [2, 2], [4, 2], "
      "[4, 5], [6, 3], [9, 3], [9, 7]], "
      "paths = [[0, 1, 2, 3], [4, 5, 6], [7, 8, 9]]);";
  const Contours contours = section("linear_extrude(height = 3) " + polygon, 1);
  EXPECT_NEAR(support::total_area(contours), 80 - 3 - 6, 1e-12);
  EXPECT_EQ(support::count_loops(contours), (LoopCounts{1, 2}));
}

TEST(Formulas, AScaledExtrusionShrinksLinearly) {
  const std::string text =
      "linear_extrude(height = 10, scale = [0.5, 0.2]) "
      "square([6, 4], center = true);";
  for (const double z : {0.5, 3.3, 9.1}) {
    const Contours contours = section(text, z);
    EXPECT_NEAR(support::total_area(contours),
                6 * (1 - 0.05 * z) * 4 * (1 - 0.08 * z), 1e-12);
    EXPECT_EQ(contours.points.size(), 4U);
  }
}

TEST(Formulas, ARotateExtrudedRectangleIsARing) {
  const Contours contours =
      section("rotate_extrude($fn = 50) translate([3, 0]) square([2, 4]);", 1);
  EXPECT_NEAR(support::total_area(contours),
              polygon_area(50, 5) - polygon_area(50, 3), 1e-11);
  EXPECT_EQ(support::count_loops(contours), (LoopCounts{1, 1}));
}

TEST(Formulas, APartOfATurnHasItsShareOfTheRing) {
  const Contours contours = section(
      "rotate_extrude(angle = 90, $fn = 40) translate([3, 0]) "
      "square([2, 4]);",
      1);
  EXPECT_NEAR(support::total_area(contours),
              (polygon_area(40, 5) - polygon_area(40, 3)) / 4, 1e-11);
}

TEST(Formulas, ATetrahedronHasSimilarSections) {
  const std::string text =
      "polyhedron(points = [[0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 3]], "
      "faces = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]);";
  for (const double z : {0.25, 1.0, 2.9}) {
    EXPECT_NEAR(support::total_area(section(text, z)), (3 - z) * (3 - z) / 2,
                1e-12);
  }
}

// The half-open rule: a solid fills [bottom, top).
TEST(Formulas, ASolidFillsItsBottomButNotItsTop) {
  EXPECT_NEAR(support::total_area(section("cube([4, 3, 2]);", 0)), 12, 1e-12);
  EXPECT_TRUE(section("cube([4, 3, 2]);", 2).is_empty());
  EXPECT_NEAR(support::total_area(section(
                  "cube([4, 3, 2]); translate([0, 0, 2]) cube([4, 2, 2]);", 2)),
              8, 1e-12);
}

// Area times thickness over all layers is the volume, to the second order in
// the thickness.
TEST(Formulas, LayersAddUpToTheVolume) {
  const Design design = Design::from_text(
      "difference() { cylinder(r1 = 6, r2 = 3, h = 9, $fn = 120); "
      "translate([0, 0, -1]) cylinder(r = 2, h = 11, $fn = 90); }");
  slicer::Settings settings;
  settings.layer_thickness = 0.05;
  settings.tolerance = 0;
  double volume = 0;
  for (const auto& layer : support::slice_layers(design.scene(), settings)) {
    EXPECT_TRUE(support::are_sound(layer.contours));
    volume += support::total_area(layer.contours) * 0.05;
  }
  // A frustum of regular polygons, less a prism.
  const double frustum = polygon_area(120, 1) * 9 * (36 + 18 + 9) / 3;
  EXPECT_NEAR(volume, frustum - polygon_area(90, 2) * 9, 0.05 * 0.05);
}

TEST(Formulas, LayersStandAtTheirMiddles) {
  const Design design =
      Design::from_text("translate([0, 0, -0.3]) cube([1, 1, 1]);");
  slicer::Settings settings;
  settings.layer_thickness = 0.25;
  const auto layers = support::slice_layers(design.scene(), settings);
  ASSERT_EQ(layers.size(), 4U);
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const double bottom = -0.3 + 0.25 * static_cast<double>(k);
    EXPECT_NEAR(layers[k].bottom, bottom, 1e-15);
    EXPECT_NEAR(layers[k].section_z, bottom + 0.125, 1e-15);
    EXPECT_NEAR(layers[k].top, bottom + 0.25, 1e-15);
  }
}

}  // namespace
}  // namespace lamina
