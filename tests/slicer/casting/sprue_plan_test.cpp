// Sprues of pieces whose heavy places are known.

#include "slicer/casting/sprue_plan.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "slicer/casting/sprue_text.h"
#include "slicer/contour/layer_measures.h"
#include "slicer/slice/slice.h"
#include "tests/support/design.h"

namespace lamina::slicer {
namespace {

using support::Design;

constexpr double kPitch = 0.2;

struct Planned {
  std::string text;
  std::optional<SpruePlan> plan;
};

Planned plan_of(const std::string& text, const SprueSizes& sizes = {}) {
  const Design design = Design::from_text(text);
  const SolidSamples samples = sample_solid(design.scene(), kPitch);
  const BallFinder balls(samples.points);
  return {text,
          plan_sprues(samples, balls, measure_thickness(samples, balls), sizes,
                      [&](std::uint32_t instance) {
                        return design.scene().instances[instance].is_visible;
                      })};
}

double volume_of(const std::string& text) {
  const Design design = Design::from_text(text);
  Settings settings;
  settings.layer_thickness = 0.02;
  return volume_of(all_layers(design.scene(), settings));
}

// What is not fed from the root when the piece has its sprues.
std::vector<Pool> unfed_with(const Planned& planned) {
  const Design design =
      Design::from_text(planned.text + sprue_text(*planned.plan));
  const SolidSamples samples = sample_solid(design.scene(), kPitch);
  const BallFinder balls(samples.points);
  return unfed_of(find_pools(samples, balls, measure_thickness(samples, balls),
                             {{.place = planned.plan->root}}));
}

const std::string kDumbbell =
    "for (x = [-8, 8]) translate([x, 0, 0]) sphere(3, $fn = 96); rotate([0, "
    "90, 0]) cylinder(r = 1, h = 16, center = true, $fn = 96);";

// A ring: a bar on two thin arms.
const std::string kRing =
    "$fn = 64; difference() { rotate([90, 0, 0]) cylinder(r = 10, h = 3, "
    "center = true); rotate([90, 0, 0]) cylinder(r = 8.6, h = 4, center = "
    "true); } translate([0, 0, 10]) cube([6, 6, 4], center = true);";

TEST(PlanSprues, SetsOneOnABall) {
  const auto planned = plan_of("sphere(4, $fn = 96);");
  ASSERT_TRUE(planned.plan);
  ASSERT_EQ(planned.plan->sprues.size(), 1U);
  const Sprue& sprue = planned.plan->sprues[0];
  EXPECT_NEAR(sprue.thickness, 8, 0.1);
  EXPECT_NEAR(sprue.diameter, kGateShare * sprue.thickness, 1e-9);
  EXPECT_LT(glm::length(sprue.end), 0.3);
  // The gate's ball reaches into the piece by its share, and no farther.
  EXPECT_NEAR(glm::length(sprue.gate) - sprue.diameter / 2,
              4 - kGateDepth * sprue.diameter / 2, 0.3);
  EXPECT_NEAR(glm::length(planned.plan->root),
              4 + SprueSizes().length + planned.plan->root_diameter / 2, 0.1);
  EXPECT_NEAR(glm::length(sprue.exit), 4, 0.3);
  EXPECT_TRUE(unfed_with(planned).empty());
}

TEST(PlanSprues, GivesEachEndOfADumbbellItsOwn) {
  const auto planned = plan_of(kDumbbell);
  ASSERT_TRUE(planned.plan);
  ASSERT_EQ(planned.plan->sprues.size(), 2U);
  EXPECT_LT(planned.plan->sprues[0].gate.x * planned.plan->sprues[1].gate.x, 0);
  EXPECT_TRUE(planned.plan->unfed.empty());
  EXPECT_TRUE(unfed_with(planned).empty());
}

TEST(PlanSprues, FeedsPiecesOfManyKinds) {
  for (const std::string& piece : {
           std::string("cube([20, 12, 2]);"),
           std::string("cylinder(r1 = 5, r2 = 1, h = 12, $fn = 96);"),
           std::string("rotate_extrude($fn = 96) translate([8, 0]) "
                       "circle(1.2, $fn = 32);"),
           std::string("translate([0, 0, 2]) sphere(3, $fn = 64); "
                       "translate([-10, -1, 0]) cube([20, 2, 1.5]);"),
           kRing,
       }) {
    const auto planned = plan_of(piece);
    ASSERT_TRUE(planned.plan) << piece;
    EXPECT_TRUE(unfed_with(planned).empty())
        << piece << unfed_text(unfed_with(planned));
  }
}

// Straight rods stay away from the piece but where they begin.
TEST(PlanSprues, KeepsAwayFromThePiece) {
  for (const std::string& piece : {kDumbbell, kRing}) {
    const auto planned = plan_of(piece);
    ASSERT_TRUE(planned.plan);
    const Design design = Design::from_text(piece);
    const SolidSamples samples = sample_solid(design.scene(), kPitch);
    const BallFinder balls(samples.points);
    const auto nearest = balls.nearest(planned.plan->root, 1e9);
    ASSERT_TRUE(nearest);
    EXPECT_GE(nearest->distance - planned.plan->root_diameter / 2,
              SprueSizes().length - kCover * kPitch);
  }
}

// A sheet thinner than the first look's cells has its own.
TEST(PlanSprues, SamplesThinSheets) {
  for (const char* sheet : {"cube([60, 60, 0.1]);", "cube([2, 3, 0.02]);",
                            "rotate([10, 20, 0]) cube([80, 80, 0.2]);"}) {
    const Design design = Design::from_text(sheet);
    EXPECT_GT(sample_casting(design.scene()).cells.size(), 1000U) << sheet;
  }
}

// In a closed ring's hole a sprue has no way out; from a ball in a shell there
// is none at all.
TEST(PlanSprues, SaysWhereThereIsNoWay) {
  const auto planned =
      plan_of("$fn = 48; difference() { sphere(10); sphere(9.5); } sphere(5);");
  EXPECT_FALSE(planned.plan);
}

TEST(PlanSprues, ComesOutWhereNobodySees) {
  const std::string seen =
      "difference() { cube([10, 10, 3]); translate([-1, -1, 2.9]) cube(12, "
      "$visible = true); }";
  const auto planned = plan_of(seen);
  ASSERT_TRUE(planned.plan);
  EXPECT_FALSE(planned.plan->sprues[0].is_seen);
  EXPECT_LT(planned.plan->sprues[0].gate.z, 2.8);
  const auto all = plan_of("cube([10, 10, 3], $visible = true);");
  ASSERT_TRUE(all.plan);
  EXPECT_TRUE(all.plan->sprues[0].is_seen);
}

TEST(PlanSprues, TakesSizesAndScales) {
  const auto planned = plan_of("cube(6);", {.root = 9, .length = 12});
  ASSERT_TRUE(planned.plan);
  EXPECT_EQ(planned.plan->root_diameter, 9);
  const Box3 box = {Vec3(0), Vec3(6)};
  const Vec3 root = planned.plan->root;
  EXPECT_GE(glm::length(root - glm::clamp(root, box.low, box.high)) - 9.0 / 2,
            12 - 1e-6);
  // The rule is of shares.
  const auto small = plan_of("cube(6);");
  const auto large = plan_of("cube(12);");
  ASSERT_TRUE(small.plan && large.plan);
  EXPECT_NEAR(large.plan->root_diameter, 2 * small.plan->root_diameter, 0.2);
}

// What the written sprues add to the piece, by its layers.
TEST(PlanSprues, CountsTheVolumeOfAll) {
  for (const std::string& piece :
       {std::string("cube(10);"), kDumbbell, kRing}) {
    for (const bool has_disc : {false, true}) {
      const auto planned = plan_of(piece, {.has_disc = has_disc});
      ASSERT_TRUE(planned.plan);
      const double added =
          volume_of(piece + sprue_text(*planned.plan)) - volume_of(piece);
      // Balls and rods have 24 to 64 sides.
      EXPECT_NEAR(planned.plan->volume, added, 0.04 * added) << piece;
    }
  }
}

TEST(SprueText, HasALineForEachAndADisc) {
  auto planned = plan_of(kDumbbell, {.has_disc = true});
  ASSERT_TRUE(planned.plan);
  planned.plan->sprues[0].at = "ring.scad:12:3";
  const std::string text = sprue_text(*planned.plan);
  EXPECT_NE(text.find(" mm³, ring.scad:12:3\n"), std::string::npos) << text;
  EXPECT_NE(text.find("module sprue_disc"), std::string::npos);
  // It is below all else, seen from the piece.
  const Design with = Design::from_text(text);
  const Vec3 down = planned.plan->direction;
  double lowest = -1e9;
  for (const csg::Instance& instance : with.scene().instances) {
    lowest = std::max(lowest, glm::dot(instance.box.center(), down));
  }
  EXPECT_NEAR(lowest,
              glm::dot(planned.plan->root, down) +
                  planned.plan->root_diameter / 2 - kDiscThickness / 2,
              0.01);
}

}  // namespace
}  // namespace lamina::slicer
