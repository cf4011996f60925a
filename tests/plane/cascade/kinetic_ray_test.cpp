#include "plane/cascade/kinetic_ray.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "csg/scene.h"
#include "ldni/section/grid.h"
#include "ldni/section/leaf_section.h"
#include "plane/loop_area.h"
#include "tests/ldni/support/scene_builder.h"
#include "tests/plane/cascade/swept.h"
#include "tests/support/contour_checks.h"

namespace lamina::plane {
namespace {

using namespace lamina::testing;
using support::are_sound;
using support::LoopCounts;

constexpr double kPi = std::numbers::pi;
const Affine kIdentity(1.0);

Contours section(const csg::Scene& scene, double height, double pitch = 0) {
  const ldni::LayerGrid grid = ldni::LayerGrid::at_heights({height});
  const ldni::LeafSectioner sectioner(scene, grid);
  ldni::SectionBlock block;
  sectioner.cut(0, 1, block);
  const BooleanProgram program = csg::program_of(scene);
  KineticRay ray(program, {.pitch = pitch});
  Contours contours;
  ray.sweep(block, 0, contours);
  EXPECT_EQ(ray.counts().unbalanced_clusters, 0U);
  EXPECT_EQ(ray.counts().capped_clusters, 0U);
  EXPECT_EQ(ray.counts().repaired_clusters, 0U);
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

// --- Laws -------------------------------------------------------------------

// A scene of one operator over leaves that overlap each other in every way.
csg::Scene mixed_scene(BooleanOp op, const Affine& placement,
                       bool is_reversed = false) {
  const std::vector<std::pair<csg::Leaf, Affine>> leaves = {
      {cube_leaf({4, 4, 4}), translated({-2, -2, -2})},
      {sphere_leaf(2.3, 24), translated({1.1, 0.4, 0.2})},
      {cylinder_leaf(1.5, 0.7, 5, 15), rotated(70, {1, 1, 0})},
      {torus_leaf(2.2, 0.6, 20, 12), rotated(25, {0, 1, 0})}};
  SceneBuilder builder(op);
  // The minuend of a difference stays the first.
  const bool keeps_first = op == BooleanOp::kDifference;
  if (keeps_first) builder.add(leaves[0].first, placement * leaves[0].second);
  const std::size_t first = keeps_first ? 1 : 0;
  for (std::size_t i = first; i < leaves.size(); ++i) {
    const std::size_t k = is_reversed ? leaves.size() - 1 - (i - first) : i;
    builder.add(leaves[k].first, placement * leaves[k].second);
  }
  return builder.finish();
}

constexpr BooleanOp kOperators[] = {BooleanOp::kUnion, BooleanOp::kIntersection,
                                    BooleanOp::kDifference};

TEST(KineticRay, TurningMirroringAndShiftingKeepAreaAndLoops) {
  for (const BooleanOp op : kOperators) {
    for (const double height : {-0.77, 0.13, 0.9}) {
      const Contours original = section(mixed_scene(op, kIdentity), height);
      for (const Affine& placement :
           {rotated(90, {0, 0, 1}), rotated(33, {0, 0, 1}), scaled({-1, 1, 1}),
            scaled({1, -1, 1}), translated({123.25, -77.5, 0})}) {
        const Contours moved = section(mixed_scene(op, placement), height);
        EXPECT_EQ(support::count_loops(moved), support::count_loops(original));
        EXPECT_NEAR(support::total_area(moved), support::total_area(original),
                    1e-9);
        EXPECT_NEAR(support::total_perimeter(moved),
                    support::total_perimeter(original), 1e-9);
      }
    }
  }
}

TEST(KineticRay, TheOrderOfOperandsDoesNotMatter) {
  for (const BooleanOp op : kOperators) {
    const Contours one = section(mixed_scene(op, kIdentity), 0.13);
    const Contours other = section(mixed_scene(op, kIdentity, true), 0.13);
    EXPECT_EQ(one.points.size(), other.points.size());
    EXPECT_EQ(support::count_loops(one), support::count_loops(other));
    EXPECT_NEAR(support::total_area(one), support::total_area(other), 1e-10);
  }
}

TEST(KineticRay, UnionAndIntersectionHaveTheAreaOfBothOperands) {
  for (double height = -1.9; height < 2; height += 0.29) {
    const auto area = [&](BooleanOp op, bool first, bool second) {
      SceneBuilder builder(op);
      if (first) builder.add(sphere_leaf(2, 40));
      if (second) {
        builder.add(torus_leaf(1.7, 0.6, 30, 20), rotated(60, {1, 0, 0}));
      }
      return support::total_area(section(builder.finish(), height));
    };
    const double both = area(BooleanOp::kUnion, true, true);
    const double common = area(BooleanOp::kIntersection, true, true);
    const double rest = area(BooleanOp::kDifference, true, true);
    const double sphere = area(BooleanOp::kUnion, true, false);
    const double torus = area(BooleanOp::kUnion, false, true);
    EXPECT_NEAR(both + common, sphere + torus, 1e-10);
    EXPECT_NEAR(rest + common, sphere, 1e-10);
  }
}

TEST(KineticRay, TheContoursAreTheSameBitsAtEveryPitch) {
  for (const BooleanOp op : kOperators) {
    const csg::Scene scene = mixed_scene(op, rotated(13, {0, 0, 1}));
    const Contours automatic = section(scene, 0.13, 0);
    for (const double pitch : {0.02, 0.0762, 0.5, 10.0}) {
      const Contours contours = section(scene, 0.13, pitch);
      EXPECT_EQ(contours.ends, automatic.ends);
      EXPECT_EQ(contours.points, automatic.points);
    }
  }
}

TEST(KineticRay, ManyLeavesOverOnePointCountLikeFew) {
  // 300 discs about one axis: 300 leaves in the middle.
  SceneBuilder builder;
  for (int i = 0; i < 300; ++i) {
    builder.add(cylinder_leaf(1 + 0.01 * i, 1 + 0.01 * i, 1, 24),
                rotated(0.37 * i, {0, 0, 1}) * translated({0.001 * i, 0, 0}));
  }
  const Contours contours = section(builder.finish(), 0.5);
  EXPECT_EQ(support::count_loops(contours), (LoopCounts{1, 0}));
  const double largest = 3.99 * 3.99 * 12 * std::sin(kPi / 12);
  EXPECT_GE(support::total_area(contours), largest);
  EXPECT_LE(support::total_area(contours), kPi * 4.3 * 4.3);
}

TEST(KineticRay, ThousandsOfCrossingsUnderHundredsOfLeavesKeepTheOutline) {
  // Discs of radius 3 with centres strewn over a disc of radius 2: every two
  // cross. So many states occur that old ones have to be forgotten on the way.
  const auto discs = [](bool is_reversed) {
    SceneBuilder builder;
    for (int i = 0; i < 200; ++i) {
      const int k = is_reversed ? 199 - i : i;
      const double distance = 2 * std::sqrt(k / 199.0);
      builder.add(cylinder_leaf(3, 3, 1, 12),
                  translated({distance * std::sin(2.4 * k),
                              distance * std::cos(2.4 * k), 0}));
    }
    return section(builder.finish(), 0.5);
  };
  const Contours contours = discs(false);
  EXPECT_EQ(support::count_loops(contours), (LoopCounts{1, 0}));
  EXPECT_NEAR(support::total_area(contours), support::total_area(discs(true)),
              1e-9);
}

// n leaves with two faces in common make n² sets of leaves, yet n + 1 states,
// and one more where a chain that ends ties with one that begins before it.
TEST(KineticRay, HundredsOfLeavesWithCommonFacesMeetAStateEach) {
  constexpr std::uint32_t kCount = 400;
  for (const BooleanOp op : {BooleanOp::kUnion, BooleanOp::kIntersection}) {
    SceneBuilder builder(op);
    for (std::uint32_t i = 0; i < kCount; ++i) {
      builder.add(cube_leaf({1, 1, 1}), translated({i * 1e-4, 0, 0}));
    }
    const csg::Scene scene = builder.finish();
    const ldni::LayerGrid grid = ldni::LayerGrid::at_heights({0.5});
    const ldni::LeafSectioner sectioner(scene, grid);
    ldni::SectionBlock block;
    sectioner.cut(0, 1, block);
    const BooleanProgram program = csg::program_of(scene);
    KineticRay ray(program);
    Contours contours;
    ray.sweep(block, 0, contours);
    ASSERT_EQ(contours.loop_count(), 1U);
    const double overhang = (kCount - 1) * 1e-4;
    EXPECT_NEAR(signed_area(contours.loop(0)),
                op == BooleanOp::kUnion ? 1 + overhang : 1 - overhang, 1e-9);
    // In one go. The ray parts the scene, and has the states of each group.
    const LayerChains layer = block.chains_of(0);
    const testing::Swept swept =
        testing::sweep(scene, {&layer, 1}, testing::kPatient);
    EXPECT_LE(swept.counts.states, kCount + 1);
    EXPECT_LE(ray.counts().states, 2 * kCount);
  }
}

TEST(KineticRay, StackedCubesUniteInEveryLayer) {
  // The upper cube stands on the lower one: at its foot the section is the
  // upper one, for a solid fills [bottom, top).
  SceneBuilder builder;
  builder.add(cube_leaf({4, 4, 1}));
  builder.add(cube_leaf({2, 2, 1}), translated({1, 1, 1}));
  const csg::Scene scene = builder.finish();
  EXPECT_EQ(support::total_area(section(scene, 0)), 16);
  EXPECT_EQ(support::total_area(section(scene, 1)), 4);
  EXPECT_TRUE(section(scene, 2).is_empty());
}

TEST(KineticRay, ABlindHoleEndsExactlyAtItsBottom) {
  // The pocket's floor and the plate's top lie on faces of the tool.
  SceneBuilder builder(BooleanOp::kDifference);
  builder.add(cube_leaf({4, 4, 2}));
  builder.add(cube_leaf({2, 2, 1}), translated({1, 1, 1}));
  const csg::Scene scene = builder.finish();
  EXPECT_EQ(section(scene, 0.999).loop_count(), 1U);
  EXPECT_EQ(section(scene, 1).loop_count(), 2U);
  EXPECT_TRUE(section(scene, 2).is_empty());
}

TEST(KineticRay, AnEmptyLayerHasNoLoops) {
  SceneBuilder builder;
  builder.add(cube_leaf({1, 1, 1}));
  const csg::Scene scene = builder.finish();
  EXPECT_TRUE(section(scene, 5).is_empty());
  EXPECT_TRUE(section(scene, -5).is_empty());
}

}  // namespace
}  // namespace lamina::plane
