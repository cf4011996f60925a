// Loops on float32 coordinates, judged by signs without rounding error.

#include "slicer/contour/round_loops.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "ldni/section/grid.h"
#include "ldni/section/leaf_section.h"
#include "plane/cascade/kinetic_ray.h"
#include "slicer/check/defects/defects.h"
#include "slicer/contour/layer_file.h"
#include "tests/support/contour_checks.h"
#include "tests/support/random_scenes.h"

namespace lamina::slicer {
namespace {

using support::SceneStyle;

bool is_float(double value) {
  return static_cast<double>(static_cast<float>(value)) == value;
}

// Every coordinate a float32; no repeat, crossing, overlap or wrong
// orientation, by exact signs; no loop through a point twice.
::testing::AssertionResult are_sound_floats(const plane::Contours& contours) {
  for (const Vec2& point : contours.points) {
    if (!is_float(point.x) || !is_float(point.y)) {
      return ::testing::AssertionFailure() << "not a float32";
    }
  }
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    std::set<std::pair<double, double>> seen;
    for (const Vec2& point : contours.loop(i)) {
      if (!seen.insert({point.x, point.y}).second) {
        return ::testing::AssertionFailure()
               << "loop " << i << " meets itself at " << point.x << ", "
               << point.y;
      }
    }
  }
  for (const Defect& defect : find_defects(closed_loops(contours))) {
    return ::testing::AssertionFailure()
           << "loop " << defect.loop << ' ' << describe(defect.kind) << " near "
           << defect.place.x << ", " << defect.place.y;
  }
  return ::testing::AssertionSuccess();
}

plane::Contours rounded(plane::Contours contours) {
  LoopRounder().round(contours);
  return contours;
}

plane::Contours loops(const std::vector<std::vector<Vec2>>& points) {
  plane::Contours contours;
  for (const auto& loop : points) support::add_loop(contours, loop);
  return contours;
}

std::vector<Vec2> rectangle(Vec2 low, Vec2 high) {
  return {low, {high.x, low.y}, high, {low.x, high.y}};
}

TEST(RoundLoops, PutsEachPointOnItsNearestFloatWhereNothingIsNear) {
  const plane::Contours exact =
      loops({{{0.1, 0.2}, {100.3, 1e-5}, {57.7, 80.1}},
             {{-3.3, 0.7}, {-1.1, 0.9}, {-2.2, 2.9}}});
  const plane::Contours result = rounded(exact);
  ASSERT_EQ(result.ends, exact.ends);
  for (std::size_t i = 0; i < exact.points.size(); ++i) {
    EXPECT_EQ(result.points[i].x, static_cast<float>(exact.points[i].x));
    EXPECT_EQ(result.points[i].y, static_cast<float>(exact.points[i].y));
  }
}

// At 100 mm float32 steps by 7.6e-6 mm.
TEST(RoundLoops, WallsAndGapsThinnerThanTheSpacingVanish) {
  const plane::Contours wall =
      rounded(loops({rectangle({100, 0}, {110, 1e-7})}));
  EXPECT_TRUE(wall.is_empty());
  const plane::Contours two =
      rounded(loops({rectangle({100, 100}, {110, 110}),
                     rectangle({110 + 1e-7, 100}, {120, 110})}));
  EXPECT_TRUE(are_sound_floats(two));
  EXPECT_EQ(two.loop_count(), 1U);
  EXPECT_EQ(support::total_area(two), 200);
}

// The tip would turn inside out: its foot is nearer to the other side than the
// spacing.
TEST(RoundLoops, SlenderTipsStaySimple) {
  for (int i = 0; i < 200; ++i) {
    const double shift = 1e-7 * i;
    const plane::Contours result = rounded(
        loops({{{90, 90}, {120, 90 + shift}, {100, 90 + 2e-6 + shift / 3}},
               {{90, 91}, {110, 92}, {90, 95}}}));
    EXPECT_TRUE(are_sound_floats(result)) << i;
    EXPECT_GE(result.loop_count(), 1U);
  }
}

TEST(RoundLoops, LoopsThatTouchInAVertexStayAsTheyAre) {
  const plane::Contours exact = loops(
      {rectangle({0.1, 0.1}, {0.7, 0.7}), rectangle({0.7, 0.7}, {1.3, 1.3})});
  LoopRounder rounder;
  plane::Contours result = exact;
  rounder.round(result);
  EXPECT_EQ(result.ends, exact.ends);
  EXPECT_EQ(rounder.snapped_layers(), 0U);
}

// Hostile scenes, near the origin and where float32 is coarse.
TEST(RoundLoops, RandomScenesStaySimpleAndDisjoint) {
  LoopRounder rounder;
  std::uint64_t layers = 0;
  for (std::uint64_t seed = 1; seed <= 240; ++seed) {
    const auto style =
        static_cast<SceneStyle>(seed % support::kSceneStyleCount);
    const csg::Scene scene =
        support::random_scene(seed, style, 2 + static_cast<int>(seed % 23));
    const ldni::LayerGrid grid = ldni::LayerGrid::uniform(
        scene.box.low.z, scene.box.high.z,
        std::max(scene.box.high.z - scene.box.low.z, 1e-3) / 7.3);
    const ldni::LeafSectioner sectioner(scene, grid);
    ldni::SectionBlock block;
    sectioner.cut(0, grid.layer_count(), block);
    const plane::BooleanProgram program = csg::program_of(scene);
    plane::KineticRay ray(program);
    for (std::uint32_t l = 0; l < grid.layer_count(); ++l) {
      plane::Contours exact;
      ray.sweep(block, l, exact);
      for (const double shift : {0.0, 1e2, 1e4, 1e6}) {
        plane::Contours result = exact;
        for (Vec2& point : result.points) {
          point += Vec2(shift, shift * 0.77);
        }
        const double area = support::total_area(exact);
        const double length = support::total_perimeter(exact);
        rounder.round(result);
        ++layers;
        ASSERT_TRUE(are_sound_floats(result))
            << "seed " << seed << ", layer " << l << ", shift " << shift;
        // Each edge moves by less than two spacings.
        const double spacing = std::max(shift, 16.0) * 0x1p-22;
        EXPECT_NEAR(support::total_area(result), area, 2 * spacing * length)
            << "seed " << seed << ", layer " << l << ", shift " << shift;
      }
    }
  }
  std::cout << layers << " layers, " << rounder.snapped_layers()
            << " of them snapped\n";
  EXPECT_GT(rounder.snapped_layers(), 100U);
}

// A star around a hole of 0.01 mm: next to the hole its spikes are as near to
// each other as float32 numbers. The moving ray alone took round after round.
TEST(RoundLoops, SpikesThatCrowdAroundAHoleStaySimple) {
  constexpr double kRadius = 50;
  constexpr double kHole = 0.01;
  for (const int corners : {2000, 32000}) {
    const double step = 2 * std::numbers::pi / corners;
    std::vector<Vec2> star;
    for (int i = 0; i < corners; ++i) {
      const double radius = i % 2 == 0 ? kRadius : kHole;
      star.push_back(
          {radius * std::cos(step * i), radius * std::sin(step * i)});
    }
    LoopRounder rounder;
    plane::Contours result = loops({star});
    rounder.round(result);
    EXPECT_EQ(rounder.snapped_layers(), corners == 2000 ? 0U : 1U);
    EXPECT_LT(rounder.most_moves(), 100);
    EXPECT_TRUE(are_sound_floats(result)) << corners;
    const double area = corners / 2.0 * kRadius * kHole * std::sin(step);
    EXPECT_NEAR(support::total_area(result), area, 0.01 * area) << corners;
  }
}

// More rings in rings than the tree of boxes can tell apart: the grid does.
TEST(RoundLoops, HundredsOfRingsInRingsStayAsTheyAre) {
  for (const double gap : {0.05, 1e-6}) {
    plane::Contours contours;
    for (int ring = 1; ring <= 300; ++ring) {
      // The last one is as near to the one before as `gap`.
      const double radius = ring < 300 ? 0.05 * ring : 0.05 * 299 + gap;
      for (int i = 0; i < 40; ++i) {
        const double angle = 0.15707963267948966 * (ring % 2 == 0 ? i : -i);
        contours.points.push_back(
            {radius * std::cos(angle), radius * std::sin(angle)});
      }
      contours.ends.push_back(
          static_cast<std::uint32_t>(contours.points.size()));
    }
    LoopRounder rounder;
    rounder.round(contours);
    EXPECT_EQ(rounder.snapped_layers(), gap < 1e-5 ? 1U : 0U);
    EXPECT_EQ(contours.loop_count() == 300, gap > 1e-5);
    EXPECT_TRUE(are_sound_floats(contours));
  }
}

}  // namespace
}  // namespace lamina::slicer
