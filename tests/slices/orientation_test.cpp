// The direction of building (--axis auto): laws and closed formulas.

#include "slicer/plan/orientation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "csg/boundary/move_scene.h"
#include "tests/support/design.h"

namespace lamina {
namespace {

using slicer::kAxes;
using slicer::Orientation;
using slicer::OrientationChoice;
using support::Design;

constexpr double kAny = std::numeric_limits<double>::infinity();

OrientationChoice choice_of(const std::string& text, double thickness = 0.1,
                            Vec3 volume = Vec3(kAny)) {
  const Design design = Design::from_text(text);
  return slicer::choose_orientation(design.scene(), thickness, volume);
}

std::string_view best_of(const std::string& text) {
  const OrientationChoice choice = choice_of(text);
  return choice.all[choice.best].axis;
}

const Orientation& of_axis(const OrientationChoice& choice,
                           std::string_view axis) {
  return *std::find_if(choice.all.begin(), choice.all.end(),
                       [&](const Orientation& o) { return o.axis == axis; });
}

TEST(ChooseOrientation, APlateLiesFlat) {
  EXPECT_EQ(best_of("cube([20, 30, 2]);"), "z");
  EXPECT_EQ(best_of("cube([2, 30, 20]);"), "x");
  EXPECT_EQ(best_of("cube([30, 2, 20]);"), "y");
}

TEST(ChooseOrientation, WhatDoesNotFitIsNotChosen) {
  const std::string plate = "cube([20, 30, 2]);";
  const auto chosen = [&](Vec3 volume) {
    const OrientationChoice choice = choice_of(plate, 0.1, volume);
    return choice.all[choice.best];
  };
  EXPECT_EQ(chosen({30, 20, 50}).axis, "z");
  EXPECT_EQ(chosen({30, 20, 50}).turn, 90);
  EXPECT_EQ(chosen({25, 25, 50}).axis, "y");
  EXPECT_EQ(chosen({25, 25, 50}).size.z, 30);
  EXPECT_EQ(chosen({35, 10, 25}).size.z, 20);
  EXPECT_EQ(chosen({35, 1, 25}).axis, "z");  // none fits
}

TEST(ChooseOrientation, HeightDecidesWhereNothingSteps) {
  const OrientationChoice choice = choice_of("cube([20, 30, 2]);");
  // All faces of a plate are flat or upright.
  for (const Orientation& o : choice.all) EXPECT_NEAR(o.cusp_error, 0, 1e-12);
  EXPECT_NEAR(of_axis(choice, "-y").size.z, 30, 1e-12);
  EXPECT_EQ(choice.reason, "the least height");
}

TEST(ChooseOrientation, AConeStandsOnItsBase) {
  // Lying down it would have more steps: 2·2rh/2 > πr². On its tip it has as
  // many, and no overhang either.
  const std::string cone = "cylinder(r1 = 5, r2 = 0, h = 10, $fn = 80);";
  EXPECT_EQ(best_of(cone), "z");
  EXPECT_EQ(best_of("rotate([0, 90, 0]) " + cone), "x");
  EXPECT_EQ(best_of("rotate([180, 0, 0]) " + cone), "-z");
  const OrientationChoice choice = choice_of("rotate([90, 0, 0]) " + cone);
  EXPECT_EQ(choice.all[choice.best].axis, "-y");
}

TEST(ChooseOrientation, CuspErrorOfAConeIsThatOfTheFormula) {
  const int n = 200;
  const OrientationChoice choice =
      choice_of(fmt::format("cylinder(r1 = 3, r2 = 0, h = 4, $fn = {});", n));
  // Area · |n_z| is the shadow of the side: the base polygon.
  const double base = 0.5 * n * 9 * std::sin(2 * M_PI / n);
  EXPECT_NEAR(of_axis(choice, "z").cusp_error, 0.1 * base, 1e-9);
  // Along x: twice the shadow of the whole, a triangle.
  EXPECT_NEAR(of_axis(choice, "x").cusp_error, 0.1 * 3 * 4 * 2, 0.01);
}

TEST(ChooseOrientation, AConeOnItsBaseHangsOverNowhere) {
  const OrientationChoice choice =
      choice_of("cylinder(r1 = 3, r2 = 0, h = 4, $fn = 200);");
  // No side is flatter than 45°.
  EXPECT_NEAR(of_axis(choice, "z").overhang, 0, 1e-9);
}

TEST(ChooseOrientation, HeightIsTheSizeAlongTheAxis) {
  const OrientationChoice choice =
      choice_of("cylinder(r1 = 3, r2 = 0, h = 4, $fn = 200);");
  EXPECT_NEAR(of_axis(choice, "x").size.z, 6, 1e-9);
  EXPECT_NEAR(of_axis(choice, "z").size.z, 4, 1e-9);
}

TEST(ChooseOrientation, OverhangIsWhatLooksDownSteeplyAndLiesNotOnTheBed) {
  // A table: the lower side of its plate hangs over, its feet stand.
  const std::string table =
      "translate([0, 0, 5]) cube([10, 10, 1]);"
      "for (x = [0, 9], y = [0, 9]) translate([x, y, 0]) cube([1, 1, 5.5]);";
  const OrientationChoice choice = choice_of(table);
  EXPECT_NEAR(of_axis(choice, "z").overhang, 100 - 4, 1e-6);
  EXPECT_NEAR(of_axis(choice, "-z").overhang, 0, 1e-6);
  EXPECT_EQ(choice.all[choice.best].axis, "-z");
}

// A part without symmetry.
constexpr const char* kOdd =
    "difference() { cube([7, 5, 3]); translate([7, 5, 3]) sphere(2, $fn = 24);"
    "translate([2, 2, -1]) cylinder(r1 = 0.6, r2 = 1.1, h = 5, $fn = 24); }"
    "translate([1, 1, 3]) rotate([20, 35, 0]) cube([1, 1, 1.5]);";

TEST(ChooseOrientation, TurningTheDesignTurnsTheChoice) {
  const OrientationChoice straight = choice_of(kOdd);
  const Orientation& best = straight.all[straight.best];
  const Vec3 direction =
      glm::inverse(glm::dmat3(slicer::turn_to_axis(best.axis))) * Vec3(0, 0, 1);
  for (const auto& [turn, matrix] :
       std::array<std::pair<const char*, glm::dmat3>, 4>{
           {{"rotate([90, 0, 0])", {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}},
            {"rotate([0, 90, 0])", {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}}},
            {"rotate([0, 0, 90])", {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}},
            {"rotate([180, 0, 0])", {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}}}}) {
    const OrientationChoice turned =
        choice_of(fmt::format("{} {{ {} }}", turn, kOdd));
    const Orientation& chosen = turned.all[turned.best];
    EXPECT_NEAR(chosen.cusp_error, best.cusp_error, 1e-6);
    EXPECT_NEAR(chosen.size.z, best.size.z, 1e-6);
    EXPECT_NEAR(chosen.overhang, best.overhang, 1e-5);
    const Vec3 found =
        glm::inverse(glm::dmat3(slicer::turn_to_axis(chosen.axis))) *
        Vec3(0, 0, 1);
    EXPECT_NEAR(glm::distance(found, matrix * direction), 0, 1e-9) << turn;
  }
}

TEST(TurnToAxis, IsRightHanded) {
  for (const std::string_view axis : kAxes) {
    const glm::dmat3 turn(slicer::turn_to_axis(axis));
    EXPECT_NEAR(glm::determinant(turn), 1, 1e-12) << axis;
  }
}

TEST(TurnToAxis, LiftsItsAxis) {
  for (const std::string_view axis : kAxes) {
    const glm::dmat3 turn(slicer::turn_to_axis(axis));
    Vec3 up(0);
    up[axis.back() - 'x'] = axis.front() == '-' ? -1 : 1;
    EXPECT_EQ(turn * up, Vec3(0, 0, 1)) << axis;
  }
}

slicer::SurfaceHeights heights_of(const csg::Scene& scene) {
  csg::BoundaryFinder finder(scene);
  return slicer::surface_heights(scene, finder);
}

TEST(SurfaceHeights, AreThoseOfTheResultNotOfItsLeaves) {
  const Design design = Design::from_text(
      "difference() { sphere(5, $fn = 40); translate([-9, -9, -9]) cube([18, "
      "18, 7.5]); translate([0, 0, 12.25]) cube(18, center = true); }");
  const slicer::SurfaceHeights heights = heights_of(design.scene());
  EXPECT_NEAR(heights.low, -1.5, 1e-7);
  EXPECT_NEAR(heights.high, 3.25, 1e-7);
}

TEST(SurfaceHeights, AreEmptyWhereNothingIsSolid) {
  const Design nothing =
      Design::from_text("difference() { cube(1); cube(2); }");
  EXPECT_TRUE(heights_of(nothing.scene()).is_empty());
}

TEST(PlaceOnBed, PutsTheLowestPointAtHeight0) {
  const Design design = Design::from_text(
      "translate([3, 4, 5]) difference() { sphere(5, $fn = 40);"
      "translate([-9, -9, -9]) cube([18, 18, 7.5]); }");
  csg::Scene scene = design.scene();
  slicer::place_on_bed(scene);
  const slicer::SurfaceHeights heights = heights_of(scene);
  EXPECT_NEAR(heights.low, 0, 1e-12);
  EXPECT_EQ(scene.box.low.z, 0);
  EXPECT_EQ(scene.box.low.x, design.scene().box.low.x);
}

TEST(PlaceOnBed, LetsTheFirstLayerLieOnTheBed) {
  const Design design =
      Design::from_text("translate([3, 4, 5]) sphere(5, $fn = 40);");
  csg::Scene scene = design.scene();
  slicer::place_on_bed(scene);
  const auto layers = support::slice_layers(scene, slicer::Settings());
  EXPECT_EQ(layers.front().bottom, 0);
  EXPECT_FALSE(layers.front().contours.is_empty());
}

}  // namespace
}  // namespace lamina
