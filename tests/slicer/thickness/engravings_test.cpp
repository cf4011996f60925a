// Depths and widths of grooves that are known by formulas.

#include "slicer/thickness/engravings.h"

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/support/design.h"

namespace lamina::slicer {
namespace {

using support::Design;

constexpr double kEngravingPitch = 0.1;
constexpr EngravingLimits kLimits = {1, 0.5};

std::vector<Engraving> find(const std::string& text, double scale = 1) {
  const Design design = Design::from_text(text);
  const SolidSamples samples =
      sample_solid(design.scene(), scale * kEngravingPitch);
  const BallFinder balls(samples.points);
  return find_engravings(samples, balls,
                         {scale * kLimits.width, scale * kLimits.depth});
}

// A plate with a groove across, as wide and as deep as that.
std::string grooved(double width, double depth) {
  return fmt::format(
      "difference() {{ cube([8, 6, 3], center = true); translate([0, 0, 1.5]) "
      "cube([{}, 9, {}], center = true); }}",
      width, 2 * depth);
}

constexpr const char* kTurns[] = {"[0, 0, 0]", "[90, 0, 0]", "[0, -90, 30]",
                                  "[35, 20, 10]", "[180, 45, 70]"};

TEST(FindEngravings, MeasuresAGrooveInAPlateAtAnyAngle) {
  for (const char* turn : kTurns) {
    for (const double width : {0.3, 0.6, 0.95}) {
      for (const double depth : {0.15, 0.3, 0.45}) {
        const auto found =
            find(fmt::format("rotate({}) {}", turn, grooved(width, depth)));
        ASSERT_EQ(found.size(), 1U) << turn << width << ' ' << depth;
        EXPECT_NEAR(found[0].depth, depth, 1e-6);
        EXPECT_NEAR(found[0].width, width, 1e-6);
        // But for what is beside no wall, at the groove's ends.
        EXPECT_NEAR(found[0].area, 6 * width, 0.15 * 6 * width + 0.1);
      }
    }
  }
}

TEST(FindEngravings, TellsOnlyThatAGrooveIsDeepEnough) {
  const auto found = find(grooved(0.4, 0.8));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].depth, kLimits.depth);
}

// Laws: twice the size, twice the depth; a mirror changes nothing.
TEST(FindEngravings, ScalesAndMirrors) {
  const std::string text =
      "difference() { cube([6, 6, 2]); translate([1, 1, 1.7]) cube([4, 0.5, "
      "1]); translate([1, 3, 1.8]) rotate(20) cube([3, 0.7, 1]); }";
  const auto found = find(text);
  ASSERT_EQ(found.size(), 2U);
  for (const char* map : {"scale(2)", "scale(2) mirror([1, 0, 0])"}) {
    const auto mapped = find(map + text, 2);
    ASSERT_EQ(mapped.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(mapped[i].depth, 2 * found[i].depth, 1e-6);
      EXPECT_NEAR(mapped[i].width, 2 * found[i].width, 1e-6);
    }
  }
}

// The way out goes through the middle of the rims, which are lower than the
// surface would be there.
TEST(FindEngravings, MeasuresAGrooveAlongACylinderFromItsRims) {
  constexpr double kRadius = 5;
  for (const double width : {0.4, 0.8}) {
    for (const double depth : {0.25, 0.4}) {
      const auto found = find(fmt::format(
          "rotate([20, 30, 0]) difference() {{ cylinder(r = {0}, h = 6, $fn = "
          "720); translate([{0} - {1}, -{2}, 1]) cube([9, 2 * {2}, 4]); }}",
          kRadius, depth, width / 2));
      ASSERT_EQ(found.size(), 1U);
      const double sag =
          kRadius - std::sqrt(kRadius * kRadius - width * width / 4);
      EXPECT_NEAR(found[0].depth, depth - sag, 1e-3);
      EXPECT_NEAR(found[0].width, width, 1e-6);
    }
  }
}

// Outside and inside of a ring, all around: a line between two rims is level.
TEST(FindEngravings, MeasuresAGrooveAroundARing) {
  for (const double floor : {-0.3, 0.3}) {
    const double surface = floor < 0 ? 10 : 8.5;
    const auto found = find(fmt::format(
        "difference() {{ cylinder(r = 10, h = 4, $fn = 360); translate([0, 0, "
        "-1]) cylinder(r = 8.5, h = 9, $fn = 360); translate([0, 0, 1.7]) "
        "rotate_extrude($fn = 360) translate([{}, 0]) square([0.6, 0.6]); }}",
        floor < 0 ? surface + floor : surface + floor - 0.6));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].depth, 0.3, 2e-3);
    EXPECT_NEAR(found[0].width, 0.6, 1e-6);
  }
}

// Along the inside of a ring the surface rises behind the rims.
TEST(FindEngravings, MeasuresAGrooveInsideARingFromCloselyBehindItsRims) {
  constexpr double kRadius = 8.5;
  const auto found = find(
      "difference() { cylinder(r = 10.5, h = 6, $fn = 720); translate([0, 0, "
      "-1]) cylinder(r = 8.5, h = 9, $fn = 720); translate([8, -0.3, 1]) "
      "cube([0.8, 0.6, 4]); }");
  ASSERT_EQ(found.size(), 1U);
  const auto height_at = [&](double beside) {
    return 8.8 - std::sqrt(kRadius * kRadius - beside * beside);
  };
  EXPECT_GE(found[0].depth, height_at(0.3) - 1e-3);
  EXPECT_LE(found[0].depth,
            height_at(0.3 + kRimSteps * kEngravingPitch) + 1e-3);
}

TEST(FindEngravings, MeasuresARoundGrooveToItsBottom) {
  for (const double radius : {0.25, 0.4}) {
    const auto found = find(fmt::format(
        "difference() {{ cube([6, 6, 3]); translate([3, 1, 3]) rotate([-90, 0, "
        "0]) cylinder(r = {}, h = 4, $fn = 96); }}",
        radius));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_LE(found[0].depth, radius + 1e-6);
    // Between two rays, half a pitch beside the bottom.
    const double beside = kEngravingPitch / 2;
    EXPECT_GE(found[0].depth,
              std::sqrt(radius * radius - beside * beside) - 1e-3);
  }
}

TEST(FindEngravings, MeasuresABlindHoleAndTheGroundBetweenRaisedBars) {
  const auto hole = find(
      "difference() { cube([4, 4, 2]); translate([2, 2, 1.65]) cylinder(d = "
      "0.8, h = 1, $fn = 64); }");
  ASSERT_EQ(hole.size(), 1U);
  EXPECT_NEAR(hole[0].depth, 0.35, 1e-6);
  const auto ground = find(
      "cube([6, 4, 2]); for (x = [1, 2.2]) translate([x, 1, 1.9]) cube([0.5, "
      "2, 0.4]);");
  ASSERT_EQ(ground.size(), 1U);
  EXPECT_NEAR(ground[0].depth, 0.3, 1e-6);
  EXPECT_NEAR(ground[0].width, 0.7, 1e-6);
}

TEST(FindEngravings, MeasuresLettersAsDeepAsTheyAre) {
  for (const double depth : {0.2, 0.35}) {
    const auto found = find(fmt::format(
        "difference() {{ translate([-1, -1, 0]) cube([10, 5, 2]); "
        "translate([0, 0, 2 - {}]) linear_extrude(1) text(\"LEH\", size = 3); "
        "}}",
        depth));
    ASSERT_GE(found.size(), 3U);
    for (const Engraving& one : found) {
      EXPECT_NEAR(one.depth, depth, 1e-6);
      EXPECT_GE(one.width, 0.3);
      EXPECT_LE(one.width, 0.6);
    }
  }
}

TEST(FindEngravings, CallsNothingElseAnEngraving) {
  for (const char* text : {
           // Edges, balls, a ring.
           "cube(5);",
           "sphere(4, $fn = 64);",
           "rotate_extrude($fn = 90) translate([9, 0]) circle(1, $fn = 24);",
           // A step up, an inner corner, a shelf beside a wall.
           "cube([6, 6, 2]); cube([3, 6, 2.3]);",
           "cube([6, 6, 2]); cube([2, 6, 8]);",
           "cube([6, 6, 2]); cube([1, 6, 2.4]); cube([6, 1, 2.4]);",
           // Wider than a groove is.
           "difference() { cube([8, 6, 3]); translate([3, 1, 2.7]) cube([1.3, "
           "4, 1]); }",
           // Through, and closed.
           "difference() { cube([6, 6, 2]); translate([2, 1, -1]) cube([0.5, "
           "4, 4]); }",
           "difference() { cube([6, 6, 4]); translate([1, 1, 1.9]) cube([4, 4, "
           "0.4]); }",
           // A notch with an edge at its bottom, and a cove.
           "difference() { cube([6, 6, 3]); translate([3, 3, 3]) rotate([0, "
           "45, 0]) cube([0.5, 8, 0.5], center = true); }",
           "difference() { cube([6, 6, 3]); translate([3, -1, 4.7]) "
           "rotate([-90, 0, 0]) cylinder(r = 2, h = 8, $fn = 96); }",
           // Two prongs on a plate.
           "cube([6, 4, 1]); for (x = [2, 3.4]) translate([x, 2, 0]) "
           "cylinder(d = 0.8, h = 3, $fn = 24);",
       }) {
    std::vector<Engraving> found = find(text);
    std::erase_if(
        found, [](const Engraving& one) { return one.depth >= kLimits.depth; });
    for (const Engraving& one : found) {
      ADD_FAILURE() << text << ": " << one.depth << " deep, " << one.width
                    << " wide, " << one.area << " mm² at " << one.place.x
                    << ", " << one.place.y << ", " << one.place.z;
    }
  }
}

}  // namespace
}  // namespace lamina::slicer
