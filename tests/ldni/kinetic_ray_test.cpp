#include "ldni/kinetic_ray.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "csg/scene.h"
#include "ldni/grid.h"
#include "ldni/leaf_section.h"
#include "tests/ldni/scene_builder.h"
#include "tests/support/contour_checks.h"

namespace lamina::ldni {
namespace {

using namespace lamina::testing;
using csg::BooleanOp;
using support::are_sound;
using support::LoopCounts;

constexpr double kPi = std::numbers::pi;
const Affine kIdentity(1.0);

Contours section(const csg::Scene& scene, double height, double pitch = 0) {
  const LayerGrid grid = LayerGrid::at_heights({height});
  const LeafSectioner sectioner(scene, grid);
  ChainBlock block;
  sectioner.cut(0, 1, block);
  KineticRay ray(scene, pitch);
  Contours contours;
  ray.sweep(block, 0, contours);
  EXPECT_EQ(ray.counts().capped_columns, 0U);
  EXPECT_EQ(ray.counts().repaired_columns, 0U);
  EXPECT_TRUE(are_sound(contours));
  return contours;
}

TEST(KineticRay, ASquareKeepsItsFourCorners) {
  SceneBuilder builder;
  builder.add(cube_leaf({2, 3, 1}));
  const Contours contours = section(builder.finish(), 0.5);
  ASSERT_EQ(contours.loop_count(), 1U);
  EXPECT_EQ(contours.points.size(), 4U);
  EXPECT_EQ(signed_area(contours.loop(0)), 6);
}

TEST(KineticRay, TouchingCubesUniteWithoutAnInnerWall) {
  for (const Vec3& by : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.5, 1, 0)}) {
    for (const double angle : {0.0, 17.0, 37.0, 90.0}) {
      const Affine turn = rotated(angle, {0, 0, 1});
      SceneBuilder builder;
      builder.add(cube_leaf({1, 1, 1}), turn);
      builder.add(cube_leaf({1, 1, 1}), turn * translated(by));
      const Contours contours = section(builder.finish(), 0.5);
      ASSERT_EQ(contours.loop_count(), 1U) << angle;
      EXPECT_EQ(contours.points.size(), by.x == 0.5 ? 8U : 4U);
      EXPECT_NEAR(signed_area(contours.loop(0)), 2, 1e-9);
    }
  }
}

TEST(KineticRay, ADifferenceWithCoplanarFacesLeavesNoSkin) {
  for (const double angle : {0.0, 17.0, 37.0, 90.0, 180.0}) {
    const Affine turn = rotated(angle, {0, 0, 1});
    SceneBuilder builder(BooleanOp::kDifference);
    builder.add(cube_leaf({3, 3, 1}), turn);
    builder.add(cube_leaf({1, 3, 1}), turn * translated({1, 0, 0}));
    const Contours contours = section(builder.finish(), 0.5);
    ASSERT_EQ(contours.loop_count(), 2U) << angle;
    EXPECT_EQ(contours.points.size(), 8U);
    EXPECT_NEAR(support::total_area(contours), 6, 1e-9);
  }
}

TEST(KineticRay, ALeafMinusItselfIsNothing) {
  for (const double angle : {0.0, 30.0, 41.0}) {
    SceneBuilder builder(BooleanOp::kDifference);
    const Affine turn = rotated(angle, {1, 2, 3});
    builder.add(sphere_leaf(2, 20), turn);
    builder.add(as_mesh(sphere_leaf(2, 20)), turn);
    EXPECT_TRUE(section(builder.finish(), 0.3).is_empty());
  }
}

TEST(KineticRay, SquaresThatTouchAtACornerAreTwoLoops) {
  for (const double angle : {0.0, 45.0, 20.0, 135.0}) {
    const Affine turn = rotated(angle, {0, 0, 1});
    SceneBuilder builder;
    builder.add(cube_leaf({1, 1, 1}), turn);
    builder.add(cube_leaf({1, 1, 1}), turn * translated({1, 1, 0}));
    const Contours contours = section(builder.finish(), 0.5);
    EXPECT_EQ(support::count_loops(contours), (LoopCounts{2, 0})) << angle;
    EXPECT_NEAR(support::total_area(contours), 2, 1e-9);
  }
}

TEST(KineticRay, HolesThatTouchAtACornerAreTwoLoops) {
  for (const double angle : {0.0, 45.0, 20.0, 135.0}) {
    const Affine turn = rotated(angle, {0, 0, 1});
    SceneBuilder builder(BooleanOp::kDifference);
    builder.add(cube_leaf({4, 4, 1}), turn);
    builder.add(cube_leaf({1, 1, 1}), turn * translated({1, 1, 0}));
    builder.add(cube_leaf({1, 1, 1}), turn * translated({2, 2, 0}));
    const Contours contours = section(builder.finish(), 0.5);
    EXPECT_EQ(support::count_loops(contours), (LoopCounts{1, 2})) << angle;
    EXPECT_NEAR(support::total_area(contours), 14, 1e-9);
  }
}

TEST(KineticRay, TwoCrossingBarsMakeACrossOfTwelveCorners) {
  SceneBuilder builder;
  builder.add(cube_leaf({5, 1, 1}), translated({-2.5, -0.5, 0}));
  builder.add(cube_leaf({1, 5, 1}), translated({-0.5, -2.5, 0}));
  const Contours contours = section(builder.finish(), 0.5);
  EXPECT_EQ(contours.points.size(), 12U);
  EXPECT_NEAR(support::total_area(contours), 9, 1e-12);
}

TEST(KineticRay, APlateWithThinGapsHasThemAllAtEveryPitch) {
  for (const double gap : {0.1, 1e-3, 1e-5}) {
    for (const double angle : {0.0, 90.0, 37.0}) {
      for (const double pitch : {0.0, 0.02, 0.5, 10.0}) {
        const Affine turn = rotated(angle, {0, 0, 1});
        SceneBuilder builder(BooleanOp::kDifference);
        builder.add(cube_leaf({6, 6, 2}), turn);
        for (int i = 1; i <= 5; ++i) {
          builder.add(cube_leaf({gap, 5, 4}),
                      turn * translated({i - gap / 2, 0.5, -1}));
        }
        const Contours contours = section(builder.finish(), 1, pitch);
        EXPECT_EQ(support::count_loops(contours), (LoopCounts{1, 5}));
        EXPECT_NEAR(support::total_area(contours), 36 - 25 * gap, 1e-8);
      }
    }
  }
}

TEST(KineticRay, ASelfOverlappingLeafIsSolidWhereItsWindingIsNotZero) {
  csg::Leaf leaf = as_mesh(cube_leaf({2, 2, 1}));
  csg::Mesh other = as_mesh(cube_leaf({2, 2, 1})).meshes[0];
  for (Vec3& vertex : other.vertices) vertex += Vec3(1, 1, 0);
  leaf.meshes.push_back(other);
  leaf.may_overlap_itself = true;
  SceneBuilder builder;
  builder.add(leaf);
  const Contours contours = section(builder.finish(), 0.5);
  EXPECT_EQ(contours.loop_count(), 1U);
  EXPECT_NEAR(support::total_area(contours), 7, 1e-9);
}

}  // namespace
}  // namespace lamina::ldni
