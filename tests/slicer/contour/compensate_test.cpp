// Laws of moving contours: every point of the result is the amount from where
// the contour was, the result is all of the solid that far inside, and what is
// lost is counted.

#include "slicer/contour/compensate.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "plane/predicates.h"
#include "tests/slicer/contour/simplify_laws.h"
#include "tests/support/contour_checks.h"
#include "tests/support/design.h"
#include "tests/support/random_scenes.h"

namespace lamina::slicer {
namespace {

using plane::Contours;
using support::add_loop;

// What rounding to the clipper's grid may add to a distance [mm].
constexpr double kRounding = 1e-7;

// counter-clockwise; clockwise for a hole
std::vector<Vec2> box(Vec2 low, Vec2 high, bool is_hole = false) {
  std::vector<Vec2> points = {low, {high.x, low.y}, high, {low.x, high.y}};
  if (is_hole) std::reverse(points.begin(), points.end());
  return points;
}

Contours of(const std::vector<std::vector<Vec2>>& loops) {
  Contours contours;
  for (const std::vector<Vec2>& loop : loops) add_loop(contours, loop);
  return contours;
}

struct Moved {
  Contours contours;
  CompensationCounts counts;
};

Moved moved(Contours contours, double amount) {
  const CompensationCounts counts = compensate(contours, amount);
  return {std::move(contours), counts};
}

// The definition, probed at random points and along the new contour.
void expect_offset(const Contours& before, double amount,
                   const std::string& what) {
  const Contours after = moved(before, amount).contours;
  EXPECT_TRUE(support::are_sound(after)) << what;
  const double distance = std::abs(amount);
  const double slack = kArcTolerance + kRounding;
  for (std::size_t i = 0; i < after.loop_count(); ++i) {
    const auto loop = after.loop(i);
    for (std::size_t j = 0; j < loop.size(); ++j) {
      const Vec2 middle = (loop[j] + loop[(j + 1) % loop.size()]) / 2.0;
      for (const Vec2 point : {loop[j], middle}) {
        EXPECT_NEAR(support::distance_to_edges(before, point), distance, slack)
            << what;
      }
    }
  }
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-6, 6);
  for (int probe = 0; probe < 2'000; ++probe) {
    const Vec2 point(place(random), place(random));
    const double away = support::distance_to_edges(before, point);
    if (std::abs(away - distance) <= slack) continue;
    const bool was_inside = support::contains(before, point);
    const bool is_inside = amount > 0 ? was_inside && away > distance
                                      : was_inside || away < distance;
    EXPECT_EQ(support::contains(after, point), is_inside)
        << what << " at " << point.x << " " << point.y;
  }
}

TEST(Compensate, NothingChangesWithoutAnAmount) {
  const Contours square = of({box({0, 0}, {2, 3})});
  EXPECT_EQ(moved(square, 0).contours.points, square.points);
}

TEST(Compensate, InwardsABoxLosesTheAmountOnEachSideAndKeepsItsCorners) {
  const Contours after = moved(of({box({0, 0}, {2, 3})}), 0.25).contours;
  EXPECT_EQ(after.points.size(), 4U);
  EXPECT_NEAR(support::total_area(after), 1.5 * 2.5, kRounding);
}

TEST(Compensate, OutwardsABoxGainsRoundCorners) {
  const double r = 0.25;
  const Contours after = moved(of({box({0, 0}, {2, 3})}), -r).contours;
  const double area = 6 + 10 * r + std::numbers::pi * r * r;
  EXPECT_LE(support::total_area(after), area + kRounding);
  EXPECT_GE(support::total_area(after),
            area - 2 * std::numbers::pi * r * kArcTolerance);
}

TEST(Compensate, HolesGoTheOtherWay) {
  const double r = 0.25;
  const Contours plate = of({box({0, 0}, {9, 9}), box({2, 2}, {5, 6}, true)});
  const double widened = 12 + 14 * r + std::numbers::pi * r * r;
  EXPECT_NEAR(support::total_area(moved(plate, r).contours),
              8.5 * 8.5 - widened, 2 * std::numbers::pi * r * kArcTolerance);
  const double outside = 81 + 36 * r + std::numbers::pi * r * r;
  EXPECT_NEAR(support::total_area(moved(plate, -r).contours),
              outside - 2.5 * 3.5, 2 * std::numbers::pi * r * kArcTolerance);
}

TEST(Compensate, TheResultIsTheOffsetByItsDefinition) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int run = 0; run < 12; ++run) {
    // A star with a star-shaped hole.
    std::vector<Vec2> outer;
    std::vector<Vec2> inner;
    const int count = 9 + static_cast<int>(random() % 40);
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * std::numbers::pi * i / count;
      const Vec2 ray(std::cos(angle), std::sin(angle));
      outer.push_back((3.2 + 1.6 * unit(random)) * ray);
      inner.insert(inner.begin(), (1.2 + 1.6 * unit(random)) * ray);
    }
    const Contours star = of({outer, inner});
    for (const double amount : {0.02, 0.3, -0.02, -0.3}) {
      expect_offset(star, amount, fmt::format("run {}, {}", run, amount));
    }
  }
}

CompensationCounts lost_inwards(const std::vector<std::vector<Vec2>>& loops) {
  return moved(of(loops), 0.1).counts;
}

TEST(Compensate, AWallThinnerThanTheBeamVanishes) {
  // Beside a block that stays.
  const auto wall = lost_inwards({box({0, 0}, {5, 0.19}), box({0, 1}, {5, 5})});
  EXPECT_EQ(wall.vanished_regions, 1U);
  EXPECT_EQ(wall.broken_walls, 0U);
}

TEST(Compensate, AWallJustAsThickAsTheBeamVanishesHoweverItIsTurned) {
  for (int degrees = 0; degrees < 360; ++degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    const Vec2 x(std::cos(angle), std::sin(angle));
    std::vector<Vec2> wall = box({-2, -0.1}, {2, 0.1});
    for (Vec2& p : wall) p = p.x * x + p.y * left_of(x);
    EXPECT_EQ(lost_inwards({wall}).vanished_regions, 1U) << degrees;
  }
}

TEST(Compensate, ARingOfThinWallIsOneLoss) {
  const auto ring =
      lost_inwards({box({0, 0}, {5, 5}), box({0.1, 0.1}, {4.9, 4.9}, true)});
  EXPECT_EQ(ring.vanished_regions, 1U);
  EXPECT_EQ(ring.broken_walls, 0U);
}

TEST(Compensate, AThinBridgeBetweenBlocksIsABrokenWall) {
  const auto bridge = lost_inwards({{{0, 0},
                                     {2, 0},
                                     {2, 1},
                                     {4, 1},
                                     {4, 0},
                                     {6, 0},
                                     {6, 2},
                                     {4, 2},
                                     {4, 1.1},
                                     {2, 1.1},
                                     {2, 2},
                                     {0, 2}}});
  EXPECT_EQ(bridge.vanished_regions, 0U);
  EXPECT_EQ(bridge.broken_walls, 1U);
}

TEST(Compensate, ThinWallsBesideHolesAreBrokenWalls) {
  // A hole near the rim, and two near each other.
  const auto holes =
      lost_inwards({box({0, 0}, {9, 9}), box({0.1, 2}, {3, 4}, true),
                    box({4, 2}, {5, 3}, true), box({5.1, 2}, {6, 3}, true)});
  EXPECT_EQ(holes.vanished_regions, 0U);
  EXPECT_EQ(holes.broken_walls, 2U);
}

TEST(Compensate, ASoundPlateLosesNothing) {
  const auto sound =
      lost_inwards({box({0, 0}, {9, 9}), box({2, 2}, {4, 4}, true)});
  EXPECT_EQ(sound.vanished_regions, 0U);
  EXPECT_EQ(sound.broken_walls, 0U);
}

CompensationCounts lost_outwards(const std::vector<std::vector<Vec2>>& loops) {
  return moved(of(loops), -0.1).counts;
}

TEST(Compensate, AThinHoleVanishes) {
  const auto pin =
      lost_outwards({box({0, 0}, {9, 9}), box({2, 2}, {2.19, 5}, true)});
  EXPECT_EQ(pin.vanished_holes, 1U);
  EXPECT_EQ(pin.closed_gaps, 0U);
}

TEST(Compensate, AThinGapBetweenBlocksCloses) {
  const auto gap = lost_outwards({box({0, 0}, {2, 2}), box({2.1, 0}, {4, 2})});
  EXPECT_EQ(gap.vanished_holes, 0U);
  EXPECT_EQ(gap.closed_gaps, 1U);
}

TEST(Compensate, ACWhoseEndsMeetPartsTheOutside) {
  const auto ends = lost_outwards({{{0, 0},
                                    {5, 0},
                                    {5, 2},
                                    {4, 2},
                                    {4, 1},
                                    {1, 1},
                                    {1, 4},
                                    {4, 4},
                                    {4, 2.1},
                                    {5, 2.1},
                                    {5, 5},
                                    {0, 5}}});
  EXPECT_EQ(ends.closed_gaps, 1U);
}

TEST(Compensate, AHoleThatAnIslandFillsUpIsOneLoss) {
  const auto island =
      lost_outwards({box({0, 0}, {5, 5}), box({1, 1}, {2, 2}, true),
                     box({1.1, 1.1}, {1.9, 1.9})});
  EXPECT_EQ(island.vanished_holes, 1U);
  EXPECT_EQ(island.closed_gaps, 0U);
}

TEST(Compensate, LossesAmongManyLoopsAreCounted) {
  // Plates with a thin wall beside them and a pierced island inside, and many
  // that stay: minutes, if each loop were asked about each.
  constexpr int kSide = 100;
  std::vector<std::vector<Vec2>> loops;
  for (int x = 0; x < kSide; ++x) {
    for (int y = 0; y < kSide; ++y) {
      const Vec2 at(10.0 * x, 10.0 * y);
      loops.push_back(box(at, at + Vec2(8)));
      loops.push_back(box(at + Vec2(1), at + Vec2(7), true));
      loops.push_back(box(at + Vec2(2), at + Vec2(6)));
      loops.push_back(box(at + Vec2(2.1), at + Vec2(4), true));
      loops.push_back(box(at + Vec2(8.5, 0), at + Vec2(8.6, 8)));
    }
  }
  for (int x = 0; x < 5 * kSide; ++x) {
    for (int y = 0; y < 5 * kSide; ++y) {
      const Vec2 at(-2.0 * x, -2.0 * y);
      loops.push_back(box(at - Vec2(2), at - Vec2(1)));
    }
  }
  const CompensationCounts counts = lost_inwards(loops);
  EXPECT_EQ(counts.vanished_regions, std::uint64_t{kSide * kSide});
  EXPECT_EQ(counts.broken_walls, std::uint64_t{kSide * kSide});
}

TEST(Compensate, LayersOfDesignsStaySoundAndCanBeSimplified) {
  for (int style = 0; style < support::kSceneStyleCount; ++style) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const csg::Scene scene = support::random_scene(
          seed, static_cast<support::SceneStyle>(style), 20);
      if (scene.box.is_empty()) continue;
      const double height = scene.box.high.z - scene.box.low.z;
      for (const Layer& layer :
           support::slice_heights(scene, {scene.box.low.z + 0.3 * height,
                                          scene.box.low.z + 0.6 * height})) {
        for (const double amount : {0.01, 0.2, -0.01, -0.2}) {
          const std::string what =
              fmt::format("style {}, seed {}, {}", style, seed, amount);
          const Contours after = moved(layer.contours, amount).contours;
          EXPECT_TRUE(support::are_sound(after)) << what;
          expect_lawful(after, 0.005, what);
        }
      }
    }
  }
}

}  // namespace
}  // namespace lamina::slicer
