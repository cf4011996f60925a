// Faces that look down rise by what light bleeds: closed formulas, laws, and a
// model of the printer that undoes it.

#include "slicer/bleed/bleed.h"

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "csg/boundary/move_scene.h"
#include "plane/region/boolean.h"
#include "plane/region/region.h"
#include "slicer/contour/layer_measures.h"
#include "slicer/hollow/hollow.h"
#include "slicer/slice/scene_parts.h"
#include "slicer/slice/slice.h"
#include "tests/support/design.h"
#include "tests/support/random_design.h"

namespace lamina::slicer {
namespace {

using plane::Region;
using support::Design;

constexpr double kLayer = 0.05;

Settings settings_of(double thickness = kLayer) {
  Settings settings;
  settings.layer_thickness = thickness;
  settings.tolerance = 0;
  return settings;
}

struct Bled {
  csg::Scene scene;
  BleedReport report;
  std::vector<std::string> warnings;
};

Bled bled(const csg::Scene& scene, double depth, double thickness = kLayer) {
  Bled result;
  result.scene = scene;
  Diagnostics diagnostics([&](const Diagnostic& message) {
    result.warnings.push_back(message.message);
  });
  result.report = compensate_bleed(result.scene, depth, settings_of(thickness),
                                   diagnostics);
  return result;
}

Bled bled(const std::string& text, double depth, double thickness = kLayer) {
  return bled(Design::from_text(text).scene(), depth, thickness);
}

std::vector<Layer> layers_of(const csg::Scene& scene,
                             double thickness = kLayer) {
  return all_layers(scene, settings_of(thickness));
}

double volume_of(const std::vector<Layer>& layers) {
  double volume = 0;
  for (const Layer& layer : layers) {
    volume += measure(layer.contours).area * (layer.top - layer.bottom);
  }
  return volume;
}

double volume_of(const csg::Scene& scene, double thickness = kLayer) {
  return volume_of(layers_of(scene, thickness));
}

double volume_of(const std::string& text, double thickness = kLayer) {
  return volume_of(Design::from_text(text).scene(), thickness);
}

// The area that only one of the two covers [mm²].
double difference(const Region& a, const Region& b) {
  const Region ab[] = {a, b};
  const Region ba[] = {b, a};
  return plane::area(plane::subtract(ab)) + plane::area(plane::subtract(ba));
}

Region region_at(const std::vector<Layer>& layers, double z) {
  for (const Layer& layer : layers) {
    if (std::abs(layer.section_z - z) < 1e-6) {
      return plane::to_region(layer.contours);
    }
  }
  return {};
}

// What a printer makes of layers that cures so many layers below each: in each
// layer, the union of what is in it and in those above.
Region printed_at(const std::vector<Layer>& layers, double z, int deeper) {
  std::vector<Region> cured;
  for (int i = 0; i <= deeper; ++i) {
    cured.push_back(region_at(layers, z + i * kLayer));
  }
  return plane::unite(cured);
}

constexpr const char* kBridge =
    "cube([2, 4, 3]); translate([8, 0, 0]) cube([2, 4, 3]); "
    "translate([0, 0, 2]) cube([10, 4, 1]);";

TEST(Bleed, ADepthOfNothingChangesNothing) {
  const Design design = Design::from_text(kBridge);
  const Bled part = bled(design.scene(), 0);
  const auto before = layers_of(design.scene());
  const auto after = layers_of(part.scene);
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(before[i].contours.points, after[i].contours.points);
  }
  EXPECT_EQ(part.scene.instances.size(), design.scene().instances.size());
}

TEST(Bleed, ABlockOnTheBedStays) {
  for (const char* text : {"cube([7, 5, 3]);", "translate([1, 2, -8]) cube(4);",
                           "cylinder(r1 = 4, r2 = 1, h = 6, $fn = 40);"}) {
    const Bled part = bled(text, 0.2);
    EXPECT_NEAR(volume_of(part.scene), volume_of(text), 1e-9) << text;
    EXPECT_TRUE(part.warnings.empty()) << text;
  }
}

// Where leaves reach below the solid, its own lowest face lies on the bed.
TEST(Bleed, TheBedIsBelowTheSolidNotBelowItsLeaves) {
  const std::string text =
      "difference() { translate([0, 0, -3]) cube([6, 6, 8]); "
      "translate([-1, -1, -4.02]) cube([8, 8, 4]); }";
  const Bled part = bled(text, 0.06);
  EXPECT_NEAR(volume_of(part.scene), volume_of(text), 1e-9);
}

TEST(Bleed, ATablesPlateLosesTheDepth) {
  const Bled part = bled(kBridge, 0.1);
  // 6 mm by 4 mm are free below the plate.
  EXPECT_NEAR(volume_of(kBridge) - volume_of(part.scene), 6 * 4 * 0.1, 1e-9);
  EXPECT_TRUE(part.warnings.empty());
}

// The lower half becomes the whole sphere within itself moved up.
TEST(Bleed, ASpheresLowerHalfIsTheSphereMovedUp) {
  const double radius = 3;
  const double depth = 0.25;
  // On a thin stem that carries it.
  const std::string sphere =
      "translate([0, 0, 8]) sphere(3, $fn = 200); "
      "cylinder(r = 0.01, h = 8, $fn = 8);";
  const Bled part = bled(sphere, depth);
  // The lens of two balls of one radius, a depth apart (Weisstein,
  // Sphere-Sphere Intersection).
  const double lens = std::numbers::pi / 12 * (4 * radius + depth) *
                      (2 * radius - depth) * (2 * radius - depth);
  EXPECT_NEAR(volume_of(part.scene), lens, 2e-3 * lens);
  for (const double z : {5.6, 6.5, 7.8}) {
    const Region at = plane::to_region(
        support::slice_heights(part.scene, {z}).front().contours);
    const double low = 8 + depth - z;
    EXPECT_NEAR(plane::area(at),
                std::numbers::pi * (radius * radius - low * low), 0.02)
        << z;
  }
}

// At a slope of 45° outwards, contours move in by the depth.
TEST(Bleed, ASteppedAndASlopingPartRiseByFormula) {
  const Bled cone = bled("cylinder(r1 = 2, r2 = 5, h = 3, $fn = 400);", 0.1);
  const double z = 1.525;
  const Region at = plane::to_region(
      support::slice_heights(cone.scene, {z}).front().contours);
  const double radius = 2 + z - 0.1;
  EXPECT_NEAR(plane::area(at), std::numbers::pi * radius * radius, 0.01);
  const Bled steps = bled(
      "for (i = [0 : 3]) translate([0, 0, i]) cylinder(r = i + 1, h = 1, $fn = "
      "60);",
      0.1);
  const double sides = 60 * std::sin(2 * std::numbers::pi / 60) / 2;
  double whole = 0;
  for (int r = 1; r <= 4; ++r) whole += sides * r * r;
  const double lost = 0.1 * sides * (16 - 1);
  EXPECT_NEAR(volume_of(steps.scene), whole - lost, 1e-6);
}

// The printer cures two layers too deep, and makes the design.
TEST(Bleed, APrinterThatBleedsMakesTheDesign) {
  std::vector<std::string> texts = {
      kBridge, "cylinder(r1 = 2, r2 = 5, h = 3, $fn = 50);",
      "for (i = [0 : 3]) translate([0, 0, i]) cylinder(r = i + 1, h = 1);",
      "translate([0, 0, 5]) rotate([90, 0, 0]) rotate_extrude($fn = 60) "
      "translate([4, 0]) circle(1, $fn = 30);",
      "difference() { cube([9, 9, 6]); translate([3, -1, 2]) cube([3, 11, "
      "2]); }"};
  for (const std::string& text : texts) {
    const Design design = Design::from_text(text);
    const auto nominal = layers_of(design.scene());
    const auto layers = layers_of(bled(design.scene(), 2 * kLayer).scene);
    const double top = nominal.back().top;
    for (const Layer& layer : nominal) {
      // Nothing is mended next to the bed, and a sharp upper rim is lost.
      if (layer.section_z < 2 * kLayer) continue;
      if (layer.section_z > top - 2 * kLayer) continue;
      const Region wanted = plane::to_region(layer.contours);
      const double wrong =
          difference(printed_at(layers, layer.section_z, 2), wanted);
      // The rims of rounded sides, which are lower than the depth.
      EXPECT_LE(wrong, 2e-3 * plane::area(wanted)) << text << layer.section_z;
    }
  }
}

TEST(Bleed, TurnsAndMirrorsAboutZChangeNothing) {
  const std::string part =
      "rotate([30, 20, 0]) cube([5, 4, 3]); translate([4, 1, 0]) sphere(2, $fn "
      "= 24);";
  const double before = volume_of(bled(part, 0.15).scene, 0.02);
  for (const std::string move :
       {"rotate(37)", "mirror([1, 0, 0])", "translate([3, -4, 2])"}) {
    const double after =
        volume_of(bled(move + " union() {" + part + "}", 0.15).scene, 0.02);
    EXPECT_NEAR(after, before, 1e-5 * before) << move;
  }
}

TEST(Bleed, ScalesWithTheDesign) {
  const double small = volume_of(bled(kBridge, 0.1).scene, 0.05);
  const double large = volume_of(
      bled("scale(3) union() {" + std::string(kBridge) + "}", 0.3, 0.15).scene,
      0.15);
  EXPECT_NEAR(large, 27 * small, 1e-6);
}

// By its definition, in every section of random designs.
TEST(Bleed, ASectionIsThatOfTheSolidWithinTheSolidADepthBelow) {
  constexpr double kDepth = 0.3;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const Design design = Design::from_text(
        "translate([-20, -20, -20]) cube(1); " +
        support::random_design(support::RandomKind::kGeneric, seed, 6));
    const csg::Scene& scene = design.scene();
    const csg::Scene after = bled(scene, kDepth, 0.5).scene;
    for (const double z : {-0.71, 0.13, 0.52, 1.04}) {
      const auto sections = support::slice_heights(scene, {z - kDepth, z});
      const Region both[] = {plane::to_region(sections[1].contours),
                             plane::to_region(sections[0].contours)};
      const Region got =
          plane::to_region(support::slice_heights(after, {z}).front().contours);
      EXPECT_LE(difference(got, plane::intersect(both)), 1e-5)
          << seed << ' ' << z;
    }
  }
}

TEST(Bleed, WallsLowerThanTheDepthAreReported) {
  const std::string text =
      "cube([2, 4, 4]); translate([0, 0, 2]) cube([10, 4, 0.15]);";
  const Bled lost = bled(text, 0.2);
  EXPECT_GT(lost.report.walls.layers, 0U);
  EXPECT_NEAR(lost.report.walls.area, (8 - 2 * 0.2) * 4, 0.1);
  EXPECT_NEAR(lost.report.walls.place.z, 2.075, 0.1);
  ASSERT_EQ(lost.warnings.size(), 1U);
  EXPECT_NE(lost.warnings[0].find("walls lower than 0.2 mm vanish"),
            std::string::npos);
  const Bled kept = bled(text, 0.1);
  EXPECT_EQ(kept.report.walls.layers, 0U);
  EXPECT_TRUE(kept.warnings.empty());
}

// A wire that is narrower than the depth as well is no rim of anything.
TEST(Bleed, LowWiresAreReported) {
  const Bled wire = bled(
      "cube([1, 1, 4]); translate([5, 0, 0]) cube([1, 1, 4]); translate([0, "
      "0.4, 2]) cube([6, 0.12, 0.15]);",
      0.2);
  EXPECT_GT(wire.report.walls.layers, 0U);
}

TEST(Bleed, RimsOfRoundPartsAreNoWalls) {
  for (const char* text :
       {"translate([0, 0, 3]) sphere(3, $fn = 100);",
        "cylinder(r1 = 1, r2 = 4, h = 3, $fn = 60); translate([0, 0, 3]) "
        "cylinder(r1 = 4, r2 = 1, h = 3, $fn = 60);",
        "difference() { cube([9, 9, 6]); translate([4, -1, 3]) rotate([-90, 0, "
        "0]) cylinder(r = 1, h = 11, $fn = 50); }"}) {
    EXPECT_TRUE(bled(text, 0.1).warnings.empty()) << text;
  }
}

TEST(Bleed, GapsLowerThanTheDepthAreReported) {
  const std::string text =
      "cube([2, 4, 4]); cube([9, 4, 2]); translate([0, 0, 2.1]) cube([9, 4, "
      "1]);";
  const Bled closed = bled(text, 0.2);
  EXPECT_EQ(closed.report.walls.layers, 0U);
  EXPECT_GT(closed.report.gaps.layers, 0U);
  ASSERT_EQ(closed.warnings.size(), 1U);
  EXPECT_NE(closed.warnings[0].find("gaps lower than 0.2 mm will close"),
            std::string::npos);
  EXPECT_TRUE(bled(text, 0.1).warnings.empty());
}

// Ceilings of cavities rise, too.
TEST(Bleed, CavitiesOfAHollowPartGetHigher) {
  const Design design = Design::from_text("cube([20, 16, 10]);");
  csg::Scene hollow = design.scene();
  Diagnostics unshown;
  hollow_out(hollow, {.wall = 1, .has_drains = false}, settings_of(0.1),
             unshown);
  const double before = volume_of(hollow, 0.1);
  const double after = volume_of(bled(hollow, 0.3, 0.1).scene, 0.1);
  EXPECT_NEAR(before - after, 18 * 14 * 0.3, 1e-6);
}

// A plate on four posts whose tips end at a height.
std::string held_plate(double tip_end) {
  return "module support_of(x, y) translate([x, y, 0]) { cylinder(d = 1, h = "
         "4, $fn = 24); translate([0, 0, 4]) cylinder(d1 = 1, d2 = 0.4, h = " +
         std::to_string(tip_end - 4) +
         ", $fn = 24); }\n"
         "translate([0, 0, 5]) cube([8, 8, 2]);\n"
         "for (x = [1, 7], y = [1, 7]) support_of(x, y);";
}

// What is above a tip has solid below it, so it stays; the tip, too.
TEST(Bleed, WhatSupportsHoldStaysOnThem) {
  for (const double tip_end : {5.0, 5.02, 5.3}) {
    const Design design = Design::from_text(held_plate(tip_end));
    const Bled part = bled(design.scene(), 0.1);
    EXPECT_TRUE(part.warnings.empty()) << tip_end;
    const auto measured = [](const csg::Scene& scene) {
      LayerDrain sink;
      Diagnostics unshown;
      return slice(scene, plan_layers(scene, settings_of()), settings_of(),
                   sink, unshown);
    };
    const SliceReport before = measured(design.scene());
    const SliceReport after = measured(part.scene);
    ASSERT_TRUE(after.supports.has_value());
    EXPECT_EQ(after.supports->contacts.size(), 4U) << tip_end;
    EXPECT_EQ(before.supports->contacts.size(), 4U) << tip_end;
    EXPECT_NEAR(after.supports->contact_area(), before.supports->contact_area(),
                0.3 * before.supports->contact_area());
    EXPECT_EQ(after.print->count(FindingKind::kIsland),
              before.print->count(FindingKind::kIsland))
        << tip_end;
    // Between the face as drawn and where it is now, the posts go on.
    const auto layers = layers_of(part.scene);
    for (const double z : {5.025, 5.075}) {
      const Region at = region_at(layers, z);
      EXPECT_EQ(at.contours.size(), 4U) << tip_end << ' ' << z;
      EXPECT_GT(plane::area(at), 4 * 0.12) << tip_end << ' ' << z;
      EXPECT_LT(plane::area(at), 4 * 0.3) << tip_end << ' ' << z;
    }
    EXPECT_NEAR(plane::area(region_at(layers, 5.125)), 64, 1e-6);
  }
}

// Supports are for nobody's eyes: their own undersides stay.
TEST(Bleed, SupportsStay) {
  const Design design = Design::from_text(
      "module support_brace() translate([0, 0, 3]) rotate([0, 60, 0]) "
      "cylinder(d = 1, h = 5);\n"
      "cube(4); support_brace();");
  const double before = volume_of(*supports_of(design.scene()));
  const auto after = supports_of(bled(design.scene(), 0.2).scene);
  ASSERT_TRUE(after.has_value());
  EXPECT_NEAR(volume_of(*after), before, 1e-9);
}

// Each color is still a part of its own.
TEST(Bleed, ColorsStay) {
  const Design design = Design::from_text(
      "color(\"red\") cube([4, 4, 3]); color(\"blue\") translate([3, 0, 2]) "
      "cube([5, 4, 3]);");
  const auto parts = colored_parts_of(bled(design.scene(), 0.1).scene);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_NEAR(volume_of(parts[0].scene), 4 * 4 * 3, 1e-6);
  EXPECT_NEAR(volume_of(parts[1].scene), 5 * 4 * 3 - 4 * 4 * 0.1, 1e-6);
}

TEST(Bleed, NothingIsLeftAlone) {
  EXPECT_TRUE(bled("cube(0);", 0.1).scene.instances.empty());
}

}  // namespace
}  // namespace lamina::slicer
