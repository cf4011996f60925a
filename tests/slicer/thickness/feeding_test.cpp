// Heavy places and what feeds them, on shapes whose answer is known.

#include "slicer/thickness/feeding.h"

#include <cstddef>
#include <iterator>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/support/design.h"

namespace lamina::slicer {
namespace {

using support::Design;

constexpr double kFeedingPitch = 0.15;

std::vector<Pool> pools_of(const std::string& text,
                           const std::vector<Gate>& gates,
                           double pitch = kFeedingPitch) {
  const Design design = Design::from_text(text);
  const SolidSamples samples = sample_solid(design.scene(), pitch);
  const BallFinder balls(samples.points);
  return find_pools(samples, balls, measure_thickness(samples, balls), gates);
}

std::vector<Pool> cut_off(const std::string& text,
                          const std::vector<Gate>& gates,
                          double pitch = kFeedingPitch) {
  std::vector<Pool> pools = pools_of(text, gates, pitch);
  std::erase_if(pools, [](const Pool& pool) { return pool.is_fed; });
  return pools;
}

// Two balls of radius 3 on a rod of radius 1.
const std::string kDumbbell =
    "for (x = [-8, 8]) translate([x, 0, 0]) sphere(3, $fn = 96); rotate([0, "
    "90, 0]) cylinder(r = 1, h = 16, center = true, $fn = 96);";

TEST(FindPools, FindsTheFarEndOfADumbbell) {
  const auto pools = cut_off(kDumbbell, {{Vec3(-11, 0, 0)}});
  ASSERT_EQ(pools.size(), 1U);
  EXPECT_LT(glm::length(pools[0].place - Vec3(8, 0, 0)), 0.2);
  EXPECT_NEAR(pools[0].thickness, 6, 0.1);
  EXPECT_NEAR(pools[0].neck_thickness, 2, 0.1);
  // The ball and perhaps half the rod.
  EXPECT_GT(pools[0].volume, 110);
  EXPECT_LT(pools[0].volume, 140);
}

TEST(FindPools, FeedsADumbbellAtBothEnds) {
  EXPECT_TRUE(
      cut_off(kDumbbell, {{Vec3(-11, 0, 0)}, {Vec3(11, 0, 0)}}).empty());
}

// The rod freezes before either ball.
TEST(FindPools, DoesNotFeedADumbbellThroughItsRod) {
  EXPECT_EQ(cut_off(kDumbbell, {{Vec3(0, 0, 1)}}).size(), 2U);
}

TEST(FindPools, FeedsAConeAtItsBaseOnly) {
  const std::string cone = "cylinder(r1 = 5, r2 = 0, h = 12, $fn = 96);";
  EXPECT_TRUE(cut_off(cone, {{Vec3(0, 0, 0)}}).empty());
  EXPECT_EQ(cut_off(cone, {{Vec3(0, 0, 12)}}).size(), 1U);
}

TEST(FindPools, FeedsARodFromAnywhere) {
  const std::string rod = "cylinder(r = 2, h = 20, $fn = 96);";
  for (const Vec3 gate :
       {Vec3(0, 0, 0), Vec3(2, 0, 3), Vec3(2, 0, 10), Vec3(0, 0, 20)}) {
    EXPECT_TRUE(cut_off(rod, {{gate}}).empty()) << gate.z;
  }
}

TEST(FindPools, CountsWhatFreezesByItselfWithoutAGate) {
  EXPECT_EQ(pools_of(kDumbbell, {}).size(), 2U);
  EXPECT_EQ(pools_of("cube(10);", {}).size(), 1U);
}

TEST(FindPools, AsksForAGateAsThickAsThePiece) {
  const std::string cube = "cube(10, center = true);";
  EXPECT_TRUE(cut_off(cube, {{Vec3(0, 0, 5), 10}}).empty());
  const auto pools = cut_off(cube, {{Vec3(0, 0, 5), 4}});
  ASSERT_EQ(pools.size(), 1U);
  EXPECT_NEAR(pools[0].neck_thickness, 4, 1e-9);
  EXPECT_NEAR(pools[0].volume, 1000, 20);
}

// Castings by hand, each with its gates, and how many of its places metal does
// not reach.
struct Casting {
  const char* text;
  std::vector<Gate> gates;
  std::size_t cut_off = 0;
};

const Casting kCastings[] = {
    // A ball on a stalk: fed at the ball, not through the stalk.
    {"sphere(3, $fn = 64); cylinder(r = 1, h = 9, $fn = 64);",
     {{Vec3(0, 0, -3)}},
     0},
    {"sphere(3, $fn = 64); cylinder(r = 1, h = 9, $fn = 64);",
     {{Vec3(0, 0, 9)}},
     1},
    // A stalk as thick as the ball, and nearly so.
    {"sphere(3, $fn = 64); cylinder(r = 3, h = 9, $fn = 64);",
     {{Vec3(0, 0, 9)}},
     0},
    {"sphere(3, $fn = 64); cylinder(r = 2.85, h = 9, $fn = 64);",
     {{Vec3(0, 0, 9)}},
     0},
    {"sphere(3, $fn = 64); cylinder(r = 2, h = 9, $fn = 64);",
     {{Vec3(0, 0, 9)}},
     1},
    // Steps of a stair, from thick to thin and back.
    {"for (i = [0 : 2]) translate([0, 0, 4 * i]) cylinder(r = 3 - i, h = 4.01, "
     "$fn = 64);",
     {{Vec3(0, 0, 0)}},
     0},
    {"for (i = [0 : 2]) translate([0, 0, 4 * i]) cylinder(r = 3 - i, h = 4.01, "
     "$fn = 64);",
     {{Vec3(0, 0, 12)}},
     1},
    // Three balls on a string, fed at the first, the middle, and all.
    {"for (x = [-9, 0, 9]) translate([x, 0, 0]) sphere(2.5, $fn = 48); "
     "translate([-9, -1, -1]) cube([18, 2, 2]);",
     {{Vec3(-11.5, 0, 0)}},
     2},
    {"for (x = [-9, 0, 9]) translate([x, 0, 0]) sphere(2.5, $fn = 48); "
     "translate([-9, -1, -1]) cube([18, 2, 2]);",
     {{Vec3(0, 0, 2.5)}},
     2},
    {"for (x = [-9, 0, 9]) translate([x, 0, 0]) sphere(2.5, $fn = 48); "
     "translate([-9, -1, -1]) cube([18, 2, 2]);",
     {{Vec3(-9, 0, 2.5)}, {Vec3(0, 0, 2.5)}, {Vec3(9, 0, 2.5)}},
     0},
    // A plate: as thick everywhere.
    {"cube([12, 9, 2]);", {{Vec3(0, 4.5, 1)}}, 0},
    // Two plates and a thinner one between.
    {"cube([4, 8, 3]); translate([12, 0, 0]) cube([4, 8, 3]); translate([3, 0, "
     "1]) cube([10, 8, 1.2]);",
     {{Vec3(0, 4, 1.5)}},
     1},
    // A ring as thick all around, with a head, fed at the shank and the head.
    {"rotate_extrude($fn = 64) translate([8, 0]) circle(1, $fn = 24); "
     "translate([0, 8.5, 0]) sphere(2.2, $fn = 48);",
     {{Vec3(0, -9, 0)}},
     1},
    {"rotate_extrude($fn = 64) translate([8, 0]) circle(1, $fn = 24); "
     "translate([0, 8.5, 0]) sphere(2.2, $fn = 48);",
     {{Vec3(0, 10.7, 0)}},
     0},
    {"rotate_extrude($fn = 64) translate([8, 0]) circle(1, $fn = 24);",
     {{Vec3(0, -9, 0)}},
     0},
    // A hollow ball: a wall as thick everywhere.
    {"difference() { sphere(5, $fn = 64); sphere(3.5, $fn = 64); }",
     {{Vec3(0, 0, 5)}},
     0},
    // A wedge, fed at its back and at its edge.
    {"linear_extrude(6) polygon([[0, 0], [12, 2.5], [12, -2.5]]);",
     {{Vec3(12, 0, 3)}},
     0},
    {"linear_extrude(6) polygon([[0, 0], [12, 2.5], [12, -2.5]]);",
     {{Vec3(0, 0, 3)}},
     1},
    // Two pieces that do not touch: a gate each, or one for both.
    {"cube(4); translate([6, 0, 0]) cube(4);", {{Vec3(2, 2, 4)}}, 1},
    {"cube(4); translate([6, 0, 0]) cube(4);",
     {{Vec3(2, 2, 4)}, {Vec3(8, 2, 4)}},
     0},
    // A ring whose shank swells to a heavy head, fed at its foot and at both.
    {"rotate_extrude($fn = 64) translate([8, 0]) circle(0.9, $fn = 24); hull() "
     "for (x = [-2, 2]) translate([x, 8.5, 0]) sphere(1.9, $fn = 48);",
     {{Vec3(0, -8.9, 0)}},
     1},
    {"rotate_extrude($fn = 64) translate([8, 0]) circle(0.9, $fn = 24); hull() "
     "for (x = [-2, 2]) translate([x, 8.5, 0]) sphere(1.9, $fn = 48);",
     {{Vec3(0, -8.9, 0)}, {Vec3(0, 10.4, 0)}},
     0},
    // Two heads, a feed at one of them.
    {"rotate_extrude($fn = 64) translate([8, 0]) circle(0.9, $fn = 24); for (y "
     "= [-8.5, 8.5]) translate([0, y, 0]) sphere(1.9, $fn = 48);",
     {{Vec3(0, 10.4, 0)}},
     1},
    // A shank that grows steadily from its foot to its head, fed at the head.
    {"for (a = [0 : 10 : 170]) for (m = [-1, 1]) hull() for (b = [a, a + 10]) "
     "rotate(90 + m * b) translate([8, 0, 0]) sphere(1.8 - b / 225, $fn = "
     "24);",
     {{Vec3(0, 9.8, 0)}},
     0},
    {"for (a = [0 : 10 : 170]) for (m = [-1, 1]) hull() for (b = [a, a + 10]) "
     "rotate(90 + m * b) translate([8, 0, 0]) sphere(1.8 - b / 225, $fn = "
     "24);",
     {{Vec3(0, -9, 0)}},
     1},
    // A bezel on a thin bar, fed at the bar's end: its floor is heavier.
    {"cube([16, 1.4, 1.4], center = true); translate([0, 0, -1.5]) "
     "difference() { cylinder(r = 3, h = 5, $fn = 64); translate([0, 0, 3.1]) "
     "cylinder(r = 2.2, h = 4, $fn = 64); }",
     {{Vec3(-8, 0, 0)}},
     1},
    // A hoop that is open, as thick from end to end.
    {"rotate_extrude(angle = 300, $fn = 64) translate([7, 0]) circle(1.1, $fn "
     "= 24);",
     {{Vec3(7, 0, 0)}},
     0},
    // A pendant: a drop below a thin bail, fed at the bail and at its heart.
    {"hull() { sphere(2.4, $fn = 48); translate([0, 5, 0]) sphere(0.8, $fn = "
     "24); } translate([0, 6.9, 0]) rotate([0, 90, 0]) rotate_extrude($fn = "
     "48) translate([1.6, 0]) circle(0.6, $fn = 24);",
     {{Vec3(0, 9.1, 0)}},
     1},
    {"hull() { sphere(2.4, $fn = 48); translate([0, 5, 0]) sphere(0.8, $fn = "
     "24); } translate([0, 6.9, 0]) rotate([0, 90, 0]) rotate_extrude($fn = "
     "48) translate([1.6, 0]) circle(0.6, $fn = 24);",
     {{Vec3(0, -2.4, 0)}},
     0},
    // A cross of bars: level sides hold the ball where they cross.
    {"cube([12, 2, 2], center = true); cube([2, 12, 2], center = true);",
     {{Vec3(-6, 0, 0)}},
     0},
    // A hollow ball with a boss, fed at its wall and at the boss.
    {"difference() { sphere(6, $fn = 64); sphere(5, $fn = 64); } "
     "translate([0, 0, 5]) sphere(1.8, $fn = 48);",
     {{Vec3(0, 0, -6)}},
     1},
    {"difference() { sphere(6, $fn = 64); sphere(5, $fn = 64); } "
     "translate([0, 0, 5]) sphere(1.8, $fn = 48);",
     {{Vec3(0, 0, 6.8)}},
     0},
    // A thin bar across a thick one, fed at either.
    {"cube([3, 12, 3], center = true); translate([6, 0, 0]) cube([12, 1.5, "
     "1.5], center = true);",
     {{Vec3(0, -6, 0)}},
     0},
    {"cube([3, 12, 3], center = true); translate([6, 0, 0]) cube([12, 1.5, "
     "1.5], center = true);",
     {{Vec3(12, 0, 0)}},
     1},
    // Two links of a chain that do not touch, fed at one.
    {"for (i = [0, 1]) translate([5 * i, 0, 0]) rotate([90 * i, 0, 0]) "
     "rotate_extrude($fn = 48) translate([4, 0]) circle(0.9, $fn = 24);",
     {{Vec3(-4.9, 0, 0)}},
     1},
    // A bar that becomes thinner in the middle, and thick again.
    {"for (i = [0 : 4]) translate([3 * i, 0, 0]) rotate([0, 90, 0]) cylinder("
     "r = 1.2 + 0.4 * abs(i - 2), h = 3.01, $fn = 48);",
     {{Vec3(0, 0, 0)}},
     1},
};

class Castings : public testing::TestWithParam<int> {};

TEST_P(Castings, AreFedAsFarAsThicknessDoesNotRise) {
  const Casting& casting = kCastings[GetParam()];
  EXPECT_EQ(cut_off(casting.text, casting.gates).size(), casting.cut_off)
      << casting.text;
}

// Laws: a casting that is turned and mirrored has the same answer, and so has
// one twice the size.
TEST_P(Castings, HaveTheSameAnswerTurnedMirroredAndScaled) {
  const Casting& casting = kCastings[GetParam()];
  std::vector<Gate> gates = casting.gates;
  // (x, y, z) → (z, -x, y) · 1.5
  for (Gate& gate : gates) {
    gate.place = 1.5 * Vec3(gate.place.z, -gate.place.x, gate.place.y);
  }
  const std::string text =
      "multmatrix([[0, 0, 1.5], [-1.5, 0, 0], [0, 1.5, 0]]) {" +
      std::string(casting.text) + "}";
  EXPECT_EQ(cut_off(text, gates, 1.5 * kFeedingPitch).size(), casting.cut_off)
      << text;
}

INSTANTIATE_TEST_SUITE_P(
    All, Castings, testing::Range(0, static_cast<int>(std::size(kCastings))));

}  // namespace
}  // namespace lamina::slicer
