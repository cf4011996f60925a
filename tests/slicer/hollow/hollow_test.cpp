// Hollow parts: closed formulas, laws, and drains that drain.

#include "slicer/hollow/hollow.h"

#include <algorithm>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "csg/boundary/move_scene.h"
#include "slicer/contour/layer_measures.h"
#include "slicer/plan/orientation.h"
#include "slicer/slice/slice.h"
#include "tests/support/design.h"
#include "tests/support/random_design.h"

namespace lamina::slicer {
namespace {

using support::Design;

constexpr HollowSizes kClosed = {.wall = 1, .has_drains = false};

Settings settings_of(double thickness) {
  Settings settings;
  settings.layer_thickness = thickness;
  return settings;
}

struct Hollowed {
  csg::Scene scene;
  HollowReport report;
  std::vector<std::string> warnings;
};

Hollowed hollowed(const csg::Scene& scene, const HollowSizes& sizes,
                  double thickness = 0.1) {
  Hollowed result;
  result.scene = scene;
  Diagnostics diagnostics([&](const Diagnostic& message) {
    result.warnings.push_back(message.message);
  });
  result.report =
      hollow_out(result.scene, sizes, settings_of(thickness), diagnostics);
  return result;
}

Hollowed hollowed(const std::string& text, const HollowSizes& sizes,
                  double thickness = 0.1) {
  return hollowed(Design::from_text(text).scene(), sizes, thickness);
}

SliceReport slice_scene(const csg::Scene& scene, double thickness = 0.1) {
  const Settings settings = settings_of(thickness);
  LayerDrain sink;
  Diagnostics diagnostics;
  return slice(scene, plan_layers(scene, settings), settings, sink,
               diagnostics);
}

TEST(Hollow, ABoxHasWallsOfTheThickness) {
  const Hollowed box = hollowed("cube([20, 16, 10]);", kClosed);
  EXPECT_EQ(box.report.cavities, 1U);
  EXPECT_NEAR(box.report.saved_volume, 18 * 14 * 8, 1e-6);
  EXPECT_NEAR(box.report.solid_volume, 20 * 16 * 10, 1e-6);
  EXPECT_TRUE(box.report.drains.empty());
  const SliceReport report = slice_scene(box.scene);
  EXPECT_NEAR(report.volume, 3200 - 18 * 14 * 8, 1e-6);
  EXPECT_EQ(report.print->count(FindingKind::kResinTrap), 1U);
}

// Edges inside a part are round in the cavity.
TEST(Hollow, AnInnerEdgeIsRounded) {
  const Hollowed part = hollowed(
      "difference() { cube([20, 20, 10]); translate([10, 10, -1]) "
      "cube([11, 11, 12]); }",
      kClosed);
  // Of an L, 8 high, with a quarter of a disk at its inner edge instead of a
  // square.
  const double corner = 1 - 3.14159265 / 4;
  const double expected = 8 * (18 * 18 - 10 * 10 + corner);
  EXPECT_NEAR(part.report.saved_volume, expected, 8 * 0.023 * 2);
  EXPECT_LE(part.report.saved_volume, expected + 1e-6);
}

TEST(Hollow, WhatIsInsideAndWhatIsLeftMakeTheSolid) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const Design design = Design::from_text(
        "cube(3); scale(3) union() {" +
        support::random_design(support::RandomKind::kGeneric, seed, 6) + "}");
    const Hollowed part = hollowed(design.scene(), kClosed, 0.2);
    const double left = slice_scene(part.scene, 0.2).volume;
    EXPECT_NEAR(left + part.report.saved_volume,
                slice_scene(design.scene(), 0.2).volume, 1e-3 + 1e-5 * left)
        << seed;
  }
}

TEST(Hollow, ATurnedPartIsHollowedAlike) {
  const std::string text =
      "cylinder(r = 6, h = 9, $fn = 60); translate([0, 0, 8]) cube([9, 4, 7], "
      "center = true);";
  const Design design = Design::from_text(text);
  const double saved =
      hollowed(design.scene(), kClosed, 0.02).report.saved_volume;
  EXPECT_GT(saved, 300);
  for (const std::string_view axis : {"x", "-y", "-z"}) {
    csg::Scene turned = design.scene();
    csg::move_scene(turned, turn_to_axis(axis), Vec3(1, 2, 3));
    EXPECT_NEAR(hollowed(turned, kClosed, 0.02).report.saved_volume, saved,
                1e-3 * saved)
        << axis;
  }
}

// Each cavity has a low drain and a high one, and nothing is trapped.
TEST(Hollow, DrainsLeadOutOfEveryCavity) {
  for (const char* text :
       {"cube([20, 20, 10]);", "sphere(9, $fn = 80);",
        "rotate_extrude($fn = 80) translate([10, 0]) circle(3, $fn = 40);",
        "cube(9); translate([14, 0, 3]) cube([9, 9, 20]);",
        "rotate([35, 20, 10]) cylinder(r1 = 9, r2 = 3, h = 20, $fn = 60);",
        "difference() { cube(20); translate([5, 5, 5]) cube([10, 10, 20]); "
        "}"}) {
    const Design design = Design::from_text(text);
    const Hollowed part = hollowed(design.scene(), {.wall = 1});
    const HollowReport& report = part.report;
    ASSERT_GE(report.cavities, 1U) << text;
    EXPECT_EQ(report.drains.size(), 2 * report.cavities) << text;
    for (const Drain& drain : report.drains) {
      EXPECT_EQ(drain.diameter, kSmallDrain);
      EXPECT_NEAR(drain.from.z, drain.to.z, 1e-9);
    }
    const SliceReport slices = slice_scene(part.scene);
    EXPECT_EQ(slices.print->count(FindingKind::kResinTrap), 0U) << text;
    EXPECT_LT(slices.volume, report.solid_volume - report.saved_volume) << text;
  }
}

TEST(Hollow, LargePartsHaveWideDrains) {
  const Hollowed part = hollowed("cube([50, 10, 10]);", {.wall = 1});
  EXPECT_EQ(part.report.drains.front().diameter, kLargeDrain);
  EXPECT_EQ(hollowed("cube(10);", {.wall = 1, .drain_diameter = 3})
                .report.drains.front()
                .diameter,
            3);
}

TEST(Hollow, WhatNoDrainFitsIntoStaysSolid) {
  // The rod's cavity is 0.2 mm wide; the cube's is beside it.
  const std::string rod = "cylinder(r = 1.1, h = 9, $fn = 64);";
  const Hollowed both =
      hollowed("cube(10); translate([20, 0, 0]) " + rod, {.wall = 1});
  EXPECT_EQ(both.report.cavities, 1U);
  EXPECT_EQ(both.report.filled, 1U);
  EXPECT_TRUE(both.warnings.empty());
  // Both parts with the drains' volume.
  EXPECT_NEAR(slice_scene(both.scene).volume,
              1000 - 512 + 3.1416 * 1.1 * 1.1 * 9, 5);
  const Hollowed alone = hollowed(rod, {.wall = 1});
  EXPECT_EQ(alone.report.cavities, 0U);
  EXPECT_EQ(alone.warnings.size(), 1U);
  EXPECT_NEAR(slice_scene(alone.scene).volume, alone.report.solid_volume, 1e-9);
}

TEST(Hollow, APlaceOfTheUsersIsDrilled) {
  const std::string text =
      "cube(10); translate([20, 0, 0]) cube(10); translate([40, 0, 0]) "
      "cube(10);";
  HollowSizes sizes = {.wall = 1};
  sizes.drains = {{{5, 5, 10}, 2}, {{5, 0, 5}, 1}};
  const Hollowed part = hollowed(text, sizes);
  EXPECT_EQ(part.report.cavities, 1U);
  EXPECT_EQ(part.report.filled, 2U);
  ASSERT_EQ(part.report.drains.size(), 2U);
  // Through the top, straight down.
  EXPECT_NEAR(glm::distance(glm::normalize(part.report.drains[0].to -
                                           part.report.drains[0].from),
                            Vec3(0, 0, 1)),
              0, 0.05);
  // Polygons of 32 sides, 1 mm deep.
  const auto rod = [](double d) { return 0.5 * 32 * 0.19509 * d * d / 4; };
  EXPECT_NEAR(slice_scene(part.scene).volume, 3000 - 512 - rod(2) - rod(1),
              0.02);
  sizes.drains.push_back({{100, 0, 0}, 2});
  const Hollowed far = hollowed(text, sizes);
  ASSERT_EQ(far.warnings.size(), 1U);
  EXPECT_NE(far.warnings[0].find("51 mm away"), std::string::npos)
      << far.warnings[0];
  EXPECT_EQ(far.report.drains.size(), 2U);
}

// What a drain takes away stands beside the part, as high as the wall is thick.
TEST(Hollow, PlugsFitTheirDrains) {
  HollowSizes sizes = {.wall = 1.5, .drain_diameter = 2, .has_plugs = true};
  const Hollowed part = hollowed("cube(20);", sizes);
  sizes.has_plugs = false;
  const Hollowed bare = hollowed("cube(20);", sizes);
  ASSERT_EQ(part.report.drains.size(), 2U);
  const double plug = 0.5 * 32 * 0.19509 * 0.95 * 0.95 * 1.5;
  const SliceReport with = slice_scene(part.scene, 0.05);
  EXPECT_NEAR(with.volume - slice_scene(bare.scene, 0.05).volume, 2 * plug,
              0.01);
  EXPECT_NEAR(with.box.high.x, 20 + 2 * (kPlugDistance + 2) - 0.05, 1e-3);
  EXPECT_EQ(with.print->count(FindingKind::kIsland), 0U);
  EXPECT_EQ(with.print->count(FindingKind::kLoosePart), 0U);
}

// What a ball sweeps in a box, by Steiner's formula.
TEST(Hollow, ClosingRoundsTheCavity) {
  const Hollowed box =
      hollowed("cube([20, 16, 12]);",
               {.wall = 1, .closing = 2, .has_drains = false}, 0.05);
  const double a = 14;
  const double b = 10;
  const double h = 6;
  const double pi = 3.14159265;
  const double rounded = a * b * h + 2 * 2 * (a * b + a * h + b * h) +
                         pi * 4 * (a + b + h) + 4.0 / 3 * pi * 8;
  EXPECT_LE(box.report.saved_volume, rounded + 1e-6);
  EXPECT_NEAR(box.report.saved_volume, rounded, 0.02 * rounded);
  EXPECT_NEAR(slice_scene(box.scene, 0.05).volume,
              box.report.solid_volume - box.report.saved_volume, 1e-3);
}

// Two boxes and a bar between them, whose cavity is 1 mm wide.
TEST(Hollow, ClosingLeavesNarrowPlacesSolid) {
  const std::string text =
      "cube(10); translate([18, 0, 0]) cube(10); translate([9, 3.5, 3.5]) "
      "cube([10, 3, 3]);";
  HollowSizes sizes = {.wall = 1, .has_drains = false};
  EXPECT_EQ(hollowed(text, sizes).report.cavities, 1U);
  sizes.closing = 0.6;
  const Hollowed closed = hollowed(text, sizes);
  EXPECT_EQ(closed.report.cavities, 2U);
  EXPECT_LT(closed.report.saved_volume, 2 * 512);
  EXPECT_GT(closed.report.saved_volume, 2 * 512 * 0.93);
  sizes.has_drains = true;
  sizes.has_plugs = true;
  const Hollowed drained = hollowed(text, sizes);
  EXPECT_EQ(drained.report.drains.size(), 4U);
  const SliceReport slices = slice_scene(drained.scene);
  EXPECT_EQ(slices.print->count(FindingKind::kResinTrap), 0U);
  EXPECT_EQ(slices.print->count(FindingKind::kLoosePart), 0U);
}

TEST(Hollow, AThinPartIsLeftAsItIs) {
  const Hollowed sheet = hollowed("cube([20, 20, 1.9]);", {.wall = 1});
  EXPECT_EQ(sheet.report.cavities, 0U);
  ASSERT_EQ(sheet.warnings.size(), 1U);
  EXPECT_EQ(sheet.warnings[0].find("nothing is hollowed"), 0U);
}

// A pore is within the ball around any of its points.
TEST(Hollow, APoreHasAWallOfItsOwn) {
  const Hollowed part =
      hollowed("difference() { sphere(10, $fn = 60); sphere(0.2, $fn = 12); }",
               {.wall = 2, .has_drains = false});
  const SliceReport report = slice_scene(part.scene);
  // The middle is solid, but for the pore.
  EXPECT_GT(report.print->count(FindingKind::kLoosePart), 0U);
  const double shell =
      part.report.solid_volume -
      hollowed("sphere(10, $fn = 60);", {.wall = 2, .has_drains = false})
          .report.saved_volume;
  const double ball = 4.0 / 3 * 3.14159265 * 2.2 * 2.2 * 2.2;
  EXPECT_NEAR(report.volume, shell + ball, 0.15 * ball);
}

}  // namespace
}  // namespace lamina::slicer
