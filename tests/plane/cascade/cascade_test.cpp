#include "plane/cascade/cascade.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "csg/scene.h"
#include "ldni/section/grid.h"
#include "ldni/section/leaf_section.h"
#include "plane/tie_distance.h"
#include "tests/ldni/support/scene_builder.h"
#include "tests/plane/cascade/swept.h"
#include "tests/support/contour_checks.h"
#include "tests/support/leaf_scenes.h"

namespace lamina::plane {
namespace {

using support::LoopCounts;
using testing::kPatient;
using testing::SceneBuilder;
using testing::Swept;
using testing::operator*;

// Sweeps a scene at some heights.
Swept sweep(const csg::Scene& scene, double patience,
            const std::vector<double>& heights = {0.5}) {
  const ldni::LayerGrid grid = ldni::LayerGrid::at_heights(heights);
  const ldni::LeafSectioner sectioner(scene, grid);
  ldni::SectionBlock block;
  sectioner.cut(0, grid.layer_count(), block);
  std::vector<LayerChains> layers;
  for (std::uint32_t l = 0; l < heights.size(); ++l) {
    layers.push_back(block.chains_of(l));
  }
  return testing::sweep(scene, layers, patience);
}

void expect_no_defect(const Contours& contours) {
  for (const auto& defect : support::find_defects(contours)) {
    ADD_FAILURE() << defect.message;
  }
}

// Bars of length 10 and width 0.1 through the origin, each turned a little
// against the one before: every two cross.
csg::Scene star(int bars) {
  SceneBuilder builder;
  for (int i = 0; i < bars; ++i) {
    builder.add(testing::cube_leaf({10, 0.1, 1}),
                testing::rotated(180.0 * i / bars, {0, 0, 1}) *
                    testing::translated({-5, -0.05, 0}));
  }
  return builder.finish();
}

// Square frames inside each other, each turned a little against the one before.
csg::Scene frames(int count) {
  SceneBuilder builder;
  for (int i = 0; i < count; ++i) {
    const double size = 40 - 0.15 * i;
    const auto square = [&builder, i](double width) {
      builder.add(testing::cube_leaf({width, width, 1}),
                  testing::rotated(0.7 * i, {0, 0, 1}) *
                      testing::translated({-width / 2, -width / 2, 0}));
    };
    builder.begin(BooleanOp::kDifference);
    square(size);
    square(size - 6);
    builder.end();
  }
  return builder.finish();
}

// Squares about the origin, each a little smaller than the one before and
// turned against it, where all but the last two are operands of an operator
// whose other operand is the rest.
csg::Scene nested_squares(int count, double turn,
                          const std::vector<BooleanOp>& ops) {
  const auto op = [&](int i) {
    return ops[static_cast<std::size_t>(i) % ops.size()];
  };
  SceneBuilder builder(op(0));
  for (int i = 0; i < count; ++i) {
    const double size = 20 + 0.1 * (count - i);
    builder.add(testing::cube_leaf({size, size, 1}),
                testing::rotated(turn * i, {0, 0, 1}) *
                    testing::translated({-size / 2, -size / 2, 0}));
    if (i + 2 < count) builder.begin(op(i + 1));
  }
  for (int i = 0; i + 2 < count; ++i) builder.end();
  return builder.finish();
}

void expect_no_change_by_cascading(const csg::Scene& scene) {
  const Swept whole = sweep(scene, kPatient);
  const Swept cascaded = sweep(scene, 0);
  expect_no_defect(cascaded.layers[0]);
  EXPECT_EQ(support::count_loops(cascaded.layers[0]),
            support::count_loops(whole.layers[0]));
  EXPECT_NEAR(support::total_area(cascaded.layers[0]),
              support::total_area(whole.layers[0]), 1e-7);
}

TEST(Cascade, PartsOperatorsInEachOther) {
  const std::vector<std::vector<BooleanOp>> all_ops = {
      {BooleanOp::kDifference},
      {BooleanOp::kDifference, BooleanOp::kUnion},
      {BooleanOp::kDifference, BooleanOp::kDifference, BooleanOp::kUnion,
       BooleanOp::kDifference, BooleanOp::kIntersection}};
  for (const std::vector<BooleanOp>& ops : all_ops) {
    expect_no_change_by_cascading(nested_squares(60, 0.7, ops));
  }
}

// Where nothing crosses, the squares count with alternating signs.
TEST(Cascade, DifferencesInEachOtherAreRings) {
  constexpr int kCount = 400;
  double area = 0;
  for (int i = 0; i < kCount; ++i) {
    const double size = 20 + 0.1 * (kCount - i);
    area += (i % 2 == 0 ? 1 : -1) * size * size;
  }
  const csg::Scene scene = nested_squares(kCount, 0, {BooleanOp::kDifference});
  for (const double patience : {0.0, 1.0}) {
    const Swept swept = sweep(scene, patience);
    EXPECT_EQ(support::count_loops(swept.layers[0]),
              (LoopCounts{kCount / 2, kCount / 2}));
    EXPECT_NEAR(support::total_area(swept.layers[0]), area, 1e-6);
  }
}

// Turned squares in each other, of which every third is lower than the others
// and every fifth level subtracts a bar through all of them.
csg::Scene barred_squares(int count) {
  SceneBuilder builder(BooleanOp::kDifference);
  for (int i = 0; i < count; ++i) {
    const double size = 20 + 0.1 * (count - i);
    builder.add(testing::cube_leaf({size, size, i % 3 == 0 ? 1.0 : 2.0}),
                testing::rotated(0.7 * i, {0, 0, 1}) *
                    testing::translated({-size / 2, -size / 2, 0}));
    if (i % 5 == 0) {
      builder.add(testing::cube_leaf({60, 0.3, 2}),
                  testing::rotated(11.0 * i, {0, 0, 1}) *
                      testing::translated({-30, 0.1 * i, 0}));
    }
    if (i + 1 < count) builder.begin(BooleanOp::kDifference);
  }
  for (int i = 0; i + 1 < count; ++i) builder.end();
  return builder.finish();
}

TEST(Cascade, PartsDifferencesInEachOtherLayerByLayer) {
  const csg::Scene scene = barred_squares(41);
  const std::vector<double> heights = {0.2, 0.5, 1.2, 1.6};
  const Swept whole = sweep(scene, kPatient, heights);
  const Swept cascaded = sweep(scene, 0, heights);
  for (std::size_t l = 0; l < heights.size(); ++l) {
    expect_no_defect(cascaded.layers[l]);
    EXPECT_EQ(support::count_loops(cascaded.layers[l]),
              support::count_loops(whole.layers[l]));
    EXPECT_NEAR(support::total_area(cascaded.layers[l]),
                support::total_area(whole.layers[l]), 1e-7);
  }
  // Upright walls.
  EXPECT_EQ(cascaded.layers[0], cascaded.layers[1]);
  EXPECT_EQ(cascaded.layers[2], cascaded.layers[3]);
}

// Every two squares cross eight times, but few of these crossings show.
TEST(Cascade, TwiceTheDifferencesInEachOtherAreNotFourTimesTheEvents) {
  const auto event_points = [](int count) {
    return sweep(nested_squares(count, 0.7, {BooleanOp::kDifference}), 1)
        .counts.event_points;
  };
  EXPECT_LT(event_points(800), 2.6 * static_cast<double>(event_points(400)));
}

TEST(Cascade, ChangesNoRegion) {
  for (const csg::Scene& scene : {star(60), frames(60)}) {
    expect_no_change_by_cascading(scene);
  }
}

TEST(Cascade, BarsThroughOnePointAreAStar) {
  constexpr int kBars = 80;
  const Swept swept = sweep(star(kBars), 1);
  EXPECT_EQ(support::count_loops(swept.layers[0]), (LoopCounts{1, 0}));
  // Half of a tip lies between the axis of a bar and the bisector to the next:
  // a right triangle, h high and h / tan(a/2) long, and a strip from there on.
  const double a = std::numbers::pi / kBars;
  const double h = 0.05;
  const double triangle = h * h / std::tan(a / 2) / 2;
  const double strip = h * (5 - h / std::tan(a / 2));
  ASSERT_GT(strip, 0);
  EXPECT_NEAR(support::total_area(swept.layers[0]),
              4 * kBars * (triangle + strip), 1e-6);
}

TEST(Cascade, LeavesOutWhatIsHidden) {
  const auto events = [](const csg::Scene& scene, double patience) {
    return sweep(scene, patience).counts.event_points;
  };
  EXPECT_LT(10 * events(frames(150), 1), events(frames(150), kPatient));
}

// Every two discs cross, behind the place where all have begun. So each sweep
// of many would be given up late.
TEST(Cascade, SweepsNoGroupInVainWhereEveryTwoCross) {
  constexpr int kDiscs = 1000;
  SceneBuilder builder;
  for (int i = 0; i < kDiscs; ++i) {
    builder.add(testing::cylinder_leaf(5, 5, 1, 16),
                testing::translated({0.002 * i, 0, 0}));
  }
  const csg::Scene scene = builder.finish();
  const Swept swept = sweep(scene, 1);
  EXPECT_EQ(support::count_loops(swept.layers[0]), (LoopCounts{1, 0}));
  // Four for each of two chains a disc; without a sample it took seven.
  EXPECT_LT(swept.counts.event_points, 8 * kDiscs);
}

// Chains that coincide begin and end at once, and none swaps.
TEST(Cascade, PartsThousandsThatCoincide) {
  SceneBuilder builder;
  for (int i = 0; i < 2000; ++i) {
    builder.add(testing::cube_leaf({3, 2, 1}), testing::rotated(30, {0, 0, 1}));
  }
  const csg::Scene scene = builder.finish();
  const Swept parted = sweep(scene, 1);
  EXPECT_GT(parted.counts.event_points,
            sweep(scene, kPatient).counts.event_points);
  expect_no_defect(parted.layers[0]);
  EXPECT_EQ(support::count_loops(parted.layers[0]), (LoopCounts{1, 0}));
  EXPECT_NEAR(support::total_area(parted.layers[0]), 6, 1e-12);
}

// The same star as one leaf that overlaps itself: there is nothing to part, so
// nothing is swept in vain.
TEST(Cascade, TriesNothingOnASingleLeaf) {
  constexpr int kBars = 80;
  csg::Leaf leaf;
  leaf.may_overlap_itself = true;
  leaf.box = {{-5, -5, 0}, {5, 5, 1}};
  for (int i = 0; i < kBars; ++i) {
    const double angle = std::numbers::pi * i / kBars;
    const Vec2 along(5 * std::cos(angle), 5 * std::sin(angle));
    const Vec2 across(-0.01 * along.y, 0.01 * along.x);
    csg::Loft& bar = leaf.lofts.emplace_back();
    bar.outline = std::make_shared<const std::vector<Vec2>>(std::vector<Vec2>{
        along + across, across - along, -along - across, along - across});
    bar.profile = {{1, 0}, {1, 1}};
  }
  SceneBuilder builder;
  builder.add(leaf);
  const csg::Scene scene = builder.finish();
  const Swept swept = sweep(scene, 1);
  EXPECT_EQ(swept.counts.event_points,
            sweep(scene, kPatient).counts.event_points);
  EXPECT_NEAR(support::total_area(swept.layers[0]),
              support::total_area(sweep(star(kBars), 1).layers[0]), 1e-6);
}

TEST(Cascade, SweepsUprightGroupsOnce) {
  // Upright bars, and a cone that is another circle in each layer.
  SceneBuilder builder(BooleanOp::kIntersection);
  builder.begin(BooleanOp::kUnion);
  for (int i = 0; i < 100; ++i) {
    builder.add(testing::cube_leaf({10, 0.1, 10}),
                testing::rotated(1.8 * i, {0, 0, 1}) *
                    testing::translated({-5, -0.05, 0}));
  }
  builder.end();
  builder.add(testing::cylinder_leaf(4, 1, 10, 24));
  const csg::Scene scene = builder.finish();
  const std::uint64_t one = sweep(scene, 0, {1}).counts.event_points;
  const Swept two = sweep(scene, 0, {1, 2});
  EXPECT_LT(two.counts.event_points, one + one / 2);
  EXPECT_EQ(two.counts.layers, 2U);
  EXPECT_NEAR(support::total_area(two.layers[1]),
              support::total_area(sweep(scene, kPatient, {2}).layers[0]), 1e-9);
}

TEST(Cascade, KeepsLayersOfFewCrossings) {
  SceneBuilder builder;
  for (int i = 0; i < 50; ++i) {
    builder.add(testing::cube_leaf({1, 1, 1}),
                testing::translated({0.9 * i, 0.01 * i, 0}));
  }
  const csg::Scene scene = builder.finish();
  const Swept once = sweep(scene, kPatient);
  const Swept usual = sweep(scene, 1);
  EXPECT_EQ(usual.layers[0].points, once.layers[0].points);
  EXPECT_EQ(usual.counts.event_points, once.counts.event_points);
}

}  // namespace
}  // namespace lamina::plane
