#include "plane/cascade/active_zones.h"

#include <vector>

#include <gtest/gtest.h>

#include "csg/scene.h"
#include "tests/ldni/support/scene_builder.h"

namespace lamina::plane {
namespace {

using testing::SceneBuilder;

const csg::Leaf kLeaf = testing::cube_leaf({1, 1, 1});

Box2 rectangle(double low_x, double low_y, double high_x, double high_y) {
  return {{low_x, low_y}, {high_x, high_y}};
}

void expect_equal(const Box2& actual, const Box2& expected) {
  EXPECT_EQ(actual.low, expected.low);
  EXPECT_EQ(actual.high, expected.high);
}

TEST(ActiveZones, OfADifferenceAreItsMinuend) {
  SceneBuilder builder(BooleanOp::kDifference);
  for (int i = 0; i < 3; ++i) builder.add(kLeaf);
  const std::vector<Box2> boxes = {
      rectangle(0, 0, 4, 4), rectangle(1, -9, 2, 9), rectangle(-9, 1, 9, 2)};
  const auto zones = active_zones(csg::program_of(builder.finish()), boxes);
  ASSERT_EQ(zones.size(), 1U);
  expect_equal(zones[0], boxes[0]);
}

TEST(ActiveZones, OfAnIntersectionAreWhatAllHaveInCommon) {
  SceneBuilder builder(BooleanOp::kIntersection);
  for (int i = 0; i < 3; ++i) builder.add(kLeaf);
  const csg::Scene scene = builder.finish();
  const std::vector<Box2> boxes = {
      rectangle(0, 0, 4, 4), rectangle(1, -9, 2, 9), rectangle(-9, 1, 9, 2)};
  expect_equal(active_zones(csg::program_of(scene), boxes)[0],
               rectangle(1, 1, 2, 2));
  const std::vector<Box2> one_missing = {boxes[0], boxes[1], {}};
  EXPECT_TRUE(active_zones(csg::program_of(scene), one_missing)[0].is_empty());
}

TEST(ActiveZones, AreBoundedByTheOperatorsAbove) {
  // (a - (b or c)) and d
  SceneBuilder builder(BooleanOp::kIntersection);
  builder.begin(BooleanOp::kDifference);
  builder.add(kLeaf);
  builder.begin(BooleanOp::kUnion);
  builder.add(kLeaf);
  builder.add(kLeaf);
  builder.end();
  builder.end();
  builder.add(kLeaf);
  const csg::Scene scene = builder.finish();
  ASSERT_EQ(scene.program[2].op, BooleanOp::kUnion);
  const std::vector<Box2> boxes = {rectangle(0, 0, 8, 8), rectangle(1, 1, 2, 2),
                                   rectangle(-5, 1, 3, 3),
                                   rectangle(-1, -1, 6, 2)};
  const auto zones = active_zones(csg::program_of(scene), boxes);
  expect_equal(zones[0], rectangle(0, 0, 6, 2));
  expect_equal(zones[1], rectangle(0, 0, 6, 2));
  expect_equal(zones[2], rectangle(0, 1, 3, 2));
}

TEST(ActiveZones, OfUnionsAloneSayNothing) {
  SceneBuilder builder;
  builder.add(kLeaf);
  builder.add(kLeaf);
  EXPECT_FALSE(has_active_zones(csg::program_of(builder.finish())));
  SceneBuilder drilled(BooleanOp::kDifference);
  drilled.add(kLeaf);
  drilled.add(kLeaf);
  EXPECT_TRUE(has_active_zones(csg::program_of(drilled.finish())));
}

}  // namespace
}  // namespace lamina::plane
