// Features through the layers of whole designs: how far they go, how thin they
// are, and what made them.

#include "slicer/check/thin/thin_features.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/diagnostic.h"
#include "slicer/contour/deviation.h"
#include "slicer/slice/slice.h"
#include "tests/support/contour_checks.h"
#include "tests/support/design.h"

namespace lamina::slicer {
namespace {

using support::Design;

struct Sliced {
  Design design;
  SliceReport report;
};

Sliced slice_text(const std::string& text, double min_feature = 0.2,
                  Settings settings = {}) {
  Sliced sliced{Design::from_text(text), {}};
  settings.min_feature = min_feature;
  support::LayerList layers;
  Diagnostics diagnostics;
  sliced.report =
      slice(sliced.design.scene(), plan_layers(sliced.design.scene(), settings),
            settings, layers, diagnostics);
  return sliced;
}

// The texts of the calls that made the sides of a feature.
std::vector<std::string> source_texts(const Sliced& sliced,
                                      std::size_t feature) {
  std::vector<std::string> texts;
  for (const std::uint32_t i : sliced.report.features.at(feature).instances) {
    texts.emplace_back(
        i == kNoInstance ? "unknown"
                         : sliced.design.scene().instances.at(i).range.text());
  }
  std::sort(texts.begin(), texts.end());
  return texts;
}

std::string turned(double angle, const std::string& text) {
  return "rotate([0, 0, " + std::to_string(angle) + "]) {" + text + "}";
}

TEST(ThinFeatures, AGapBetweenPlatesIsOneFeatureWithBothPlates) {
  for (const double angle : {0.0, 37.0, 90.0}) {
    for (const char* const gap : {"0.1", "0.001", "0.00003"}) {
      const Sliced sliced = slice_text(
          turned(angle,
                 "translate([1, 2, 0]) cube([3, 5, 2]);"
                 "translate([4 + " +
                     std::string(gap) + ", 1, -1]) cube([3.5, 9, 4]);"));
      ASSERT_EQ(sliced.report.features.size(), 1U) << angle << ' ' << gap;
      const ThinFeature& feature = sliced.report.features[0];
      EXPECT_EQ(feature.kind, ThinKind::kGap);
      EXPECT_NEAR(feature.width, std::stod(gap), 1e-9);
      EXPECT_NEAR(feature.bottom, 0, 1e-9);
      EXPECT_NEAR(feature.top, 2, 1e-9);
      EXPECT_EQ(feature.last_layer - feature.first_layer + 1, 40U);
      EXPECT_EQ(
          source_texts(sliced, 0),
          (std::vector<std::string>{"cube([3, 5, 2])", "cube([3.5, 9, 4])"}));
    }
  }
}

TEST(ThinFeatures, AWallBetweenTwoHolesIsMadeByThem) {
  const Sliced sliced = slice_text(
      "difference() { cube([9, 6, 2]);"
      "translate([3, 3, -1]) cylinder(r = 1, h = 4, $fn = 64);"
      "translate([5.6, 3, -1]) cylinder(r = 1.5, h = 4, $fn = 64); }");
  ASSERT_EQ(sliced.report.features.size(), 1U);
  EXPECT_EQ(sliced.report.features[0].kind, ThinKind::kWall);
  EXPECT_NEAR(sliced.report.features[0].width, 0.1, 1e-9);
  EXPECT_NEAR(sliced.report.features[0].place.x, 4.05, 1e-9);
  EXPECT_NEAR(sliced.report.features[0].place.y, 3, 1e-9);
  EXPECT_EQ(source_texts(sliced, 0),
            (std::vector<std::string>{"cylinder(r = 1, h = 4, $fn = 64)",
                                      "cylinder(r = 1.5, h = 4, $fn = 64)"}));
}

TEST(ThinFeatures, UprightWallsAreKnownByTheirLeaves) {
  // Its sides lie in the moving ray and belong to no chain.
  const Sliced sliced = slice_text(
      "cube(5);"
      "translate([-3, 1, 2]) cube([3, 0.1, 1]);");
  ASSERT_EQ(sliced.report.features.size(), 1U);
  EXPECT_EQ(
      source_texts(sliced, 0),
      (std::vector<std::string>{"cube([3, 0.1, 1])", "cube([3, 0.1, 1])"}));
}

TEST(ThinFeatures, UprightWallsAlongYAreKnownByTheirLeaves) {
  const Sliced along_y = slice_text("cube([0.1, 3, 1]);");
  ASSERT_EQ(along_y.report.features.size(), 1U);
  EXPECT_EQ(
      source_texts(along_y, 0),
      (std::vector<std::string>{"cube([0.1, 3, 1])", "cube([0.1, 3, 1])"}));
}

TEST(ThinFeatures, ACoatCountsToTheFirstLeafThatHasIt) {
  const Sliced sliced = slice_text("cube([0.1, 3, 1]); cube([0.1, 3, 1.0]);");
  EXPECT_EQ(source_texts(sliced, 0)[0], "cube([0.1, 3, 1])");
}

TEST(ThinFeatures, ATubeIsOneWall) {
  const Sliced sliced = slice_text(
      "difference() { cylinder(r = 3, h = 2, $fn = 100);"
      "translate([0, 0, -1]) cylinder(r = 2.9, h = 4, $fn = 100); }");
  ASSERT_EQ(sliced.report.features.size(), 1U);
  EXPECT_EQ(sliced.report.features[0].kind, ThinKind::kWall);
  EXPECT_NEAR(sliced.report.features[0].width,
              0.1 * std::cos(std::numbers::pi / 100), 1e-9);
  EXPECT_NEAR(sliced.report.features[0].high.x, 2.95, 0.01);
  EXPECT_NEAR(sliced.report.features[0].low.y, -2.95, 0.01);
}

TEST(ThinFeatures, AConesTipIsThinFromWhereItIs) {
  const Sliced sliced =
      slice_text("cylinder(r1 = 1, r2 = 0, h = 4, $fn = 64);");
  ASSERT_EQ(sliced.report.features.size(), 1U);
  const ThinFeature& feature = sliced.report.features[0];
  // At height z the inscribed circle has the diameter (4 - z) / 2 · cos(π/64).
  const auto width_at = [](std::uint32_t layer) {
    return (4 - 0.05 * (layer - 0.5)) / 2 * std::cos(std::numbers::pi / 64);
  };
  EXPECT_LT(width_at(feature.first_layer), 0.2);
  EXPECT_GT(width_at(feature.first_layer - 1), 0.2);
  EXPECT_EQ(feature.last_layer, 80U);
  EXPECT_EQ(feature.layer, 80U);
  EXPECT_NEAR(feature.width, width_at(80), 1e-9);
  EXPECT_LT(glm::length(feature.place), 1e-6);
}

TEST(ThinFeatures, ProngsAreFeaturesOneByOne) {
  const Sliced sliced = slice_text(
      "cylinder(r = 4, h = 1, $fn = 90); for (i = [0 : 5]) rotate(60 * i)"
      "translate([3, 0, 0.5]) cylinder(d = 0.18, h = 2, $fn = 12);");
  ASSERT_EQ(sliced.report.features.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    const ThinFeature& feature = sliced.report.features[i];
    EXPECT_EQ(feature.kind, ThinKind::kWall);
    EXPECT_NEAR(feature.width, 0.18 * std::cos(std::numbers::pi / 12), 1e-9);
    EXPECT_NEAR(glm::length(feature.place), 3, 1e-7);
    EXPECT_NEAR(feature.bottom, 1, 1e-9);
    EXPECT_NEAR(feature.top, 2.5, 1e-9);
    EXPECT_EQ(source_texts(sliced, i)[0],
              "cylinder(d = 0.18, h = 2, $fn = 12)");
  }
}

TEST(ThinFeatures, ProngsOfOneMedialAxisStayApart) {
  // Their stretches are as short as rounding, which has no direction.
  for (const int prongs : {2, 3, 4, 5, 7, 8, 12}) {
    const Sliced sliced = slice_text(
        "for (i = [1 : " + std::to_string(prongs) + "]) rotate(45 + 360 / " +
        std::to_string(prongs) +
        " * i) translate([2.5, 0, 0]) cylinder(d = 0.18, h = 4, $fn = 24);");
    EXPECT_EQ(sliced.report.features.size(), static_cast<std::size_t>(prongs));
  }
}

TEST(ThinFeatures, APlaceMadeByTwoLinesIsTwoFeatures) {
  // A thin prong on a thin plate: one thin place, and two lines to repair.
  const Sliced sliced = slice_text(
      "cube([3, 0.15, 0.1]); translate([1, 0, 0]) cube([0.18, 0.15, 2]);");
  ASSERT_EQ(sliced.report.features.size(), 2U);
  EXPECT_EQ(source_texts(sliced, 0)[0], "cube([3, 0.15, 0.1])");
  EXPECT_EQ(source_texts(sliced, 1)[0], "cube([0.18, 0.15, 2])");
  EXPECT_EQ(sliced.report.features[0].last_layer, 2U);
  EXPECT_NEAR(sliced.report.features[0].height, 2, 1e-9);
  EXPECT_NEAR(sliced.report.features[1].height, 2, 1e-9);
}

TEST(ThinFeatures, AWireOfManySidesIsOneWall) {
  // The disk in its middle touches all sides at once, so that 187,000 pairs of
  // them make a stretch there: minutes, if each were joined with each.
  Settings settings;
  settings.layer_thickness = 0.5;
  const Sliced sliced =
      slice_text("cylinder(r = 0.14, h = 1, $fn = 1500);", 0.3, settings);
  ASSERT_EQ(sliced.report.features.size(), 1U);
  const ThinFeature& wire = sliced.report.features[0];
  EXPECT_EQ(wire.kind, ThinKind::kWall);
  EXPECT_NEAR(wire.width, 0.28 * std::cos(std::numbers::pi / 1500), 1e-6);
  EXPECT_NEAR(wire.height, 1, 1e-9);
  EXPECT_NEAR(wire.place.x, 0, 1e-6);
  EXPECT_NEAR(wire.place.y, 0, 1e-6);
}

TEST(ThinFeatures, AWallThatLeansIsOneFeature) {
  for (const double lean : {0.0, 0.5, 1.0}) {
    for (const double width : {0.001, 0.05, 0.19}) {
      const Sliced sliced = slice_text(
          "multmatrix([[1, 0, " + std::to_string(lean) +
          "], [0, 1, 0]]) cube([" + std::to_string(width) + ", 5, 3]);");
      ASSERT_EQ(sliced.report.features.size(), 1U) << lean << ' ' << width;
      EXPECT_NEAR(sliced.report.features[0].width, width, 1e-9);
      EXPECT_EQ(sliced.report.features[0].last_layer, 60U);
    }
  }
}

TEST(ThinFeatures, ArmsThatJoinAreOneWall) {
  // Two thin walls that meet: two below, one from there on, and a gap between.
  const Sliced sliced = slice_text(
      "rotate([90, 0, 0]) linear_extrude(5) for (s = [-1, 1])"
      "polygon([[s, 0], [s + 0.1, 0], [0.1, 2], [0.1, 3], [0, 3], [0, 2]]);");
  ASSERT_EQ(sliced.report.features.size(), 2U);
  const ThinFeature& wall = sliced.report.features[0];
  EXPECT_EQ(wall.kind, ThinKind::kWall);
  EXPECT_EQ(wall.first_layer, 1U);
  EXPECT_EQ(wall.last_layer, 60U);
  const ThinFeature& gap = sliced.report.features[1];
  EXPECT_EQ(gap.kind, ThinKind::kGap);
  // It is 2 - z - 0.1 wide at z.
  EXPECT_NEAR(gap.bottom, 1.7, 1e-9);
  EXPECT_NEAR(gap.top, 1.9, 1e-9);
  EXPECT_NEAR(gap.width, 0.025, 1e-9);
}

TEST(ThinFeatures, WhatIsAsWideAsAskedForIsNotThin) {
  EXPECT_TRUE(
      slice_text(turned(37, "cube([0.2, 5, 1]);")).report.features.empty());
  EXPECT_EQ(slice_text(turned(37, "cube([0.2, 5, 1]);"), 0.20001)
                .report.features.size(),
            1U);
}

TEST(ThinFeatures, SimplificationDoesNotChangeThem) {
  const std::string text =
      "difference() { sphere(3, $fn = 200); translate([0.02, 0, 0])"
      "sphere(2.9, $fn = 170); }";
  Settings coarse;
  coarse.tolerance = 0.05;
  Settings exact;
  exact.tolerance = 0;
  const auto a = slice_text(text, 0.2, coarse).report.features;
  const auto b = slice_text(text, 0.2, exact).report.features;
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].width, b[i].width);
    EXPECT_EQ(a[i].place, b[i].place);
  }
}

TEST(ThinFeatures, TheyAreTheSameForAnyNumberOfThreads) {
  const std::string text =
      "for (i = [0 : 40]) rotate([i * 3, 0, i * 17]) translate([i / 5, 0, 0])"
      "cube([0.3, 4, 0.15]);";
  Settings one;
  one.threads = 1;
  Settings many;
  many.threads = 5;
  const auto a = slice_text(text, 0.3, one).report.features;
  const auto b = slice_text(text, 0.3, many).report.features;
  ASSERT_GT(a.size(), 10U);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].width, b[i].width);
    EXPECT_EQ(a[i].first_layer, b[i].first_layer);
    EXPECT_EQ(a[i].instances, b[i].instances);
  }
}

TEST(ThinFeatures, EverySideHasALeaf) {
  const Sliced sliced = slice_text(
      "difference() { union() { sphere(4, $fn = 60); for (i = [0 : 30])"
      "rotate([i * 31, i * 17, 0]) translate([i / 9, 0, 0])"
      "cube([0.4, 5, 0.15]); }"
      "for (i = [0 : 20]) rotate([i * 11, i * 29, 5]) translate([0, 0, -i / 5])"
      "cylinder(r = 0.1 + i / 50, h = 9, $fn = 24); }",
      0.4);
  ASSERT_GT(sliced.report.features.size(), 50U);
  for (const ThinFeature& feature : sliced.report.features) {
    EXPECT_NE(feature.instances[0], kNoInstance);
    EXPECT_NE(feature.instances[1], kNoInstance);
  }
}

TEST(Deviation, RoundingIsHalfAStepOfFloat32) {
  // Between 8 and 16 the numbers are 2⁻²⁰ apart.
  EXPECT_DOUBLE_EQ(float32_rounding(10), std::ldexp(std::sqrt(2), -21));
  for (const double x : {0.0123, 7.77, 123.456, 9999.9}) {
    EXPECT_LE(std::abs(static_cast<double>(static_cast<float>(x)) - x),
              float32_rounding(x));
  }
}

}  // namespace
}  // namespace lamina::slicer
