#include "plane/cascade/covered_leaves.h"

#include <cstdint>
#include <random>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "csg/scene.h"
#include "ldni/section/grid.h"
#include "ldni/section/leaf_section.h"
#include "plane/tie_distance.h"
#include "tests/ldni/support/scene_builder.h"
#include "tests/plane/cascade/swept.h"
#include "tests/support/contour_checks.h"

namespace lamina::plane {
namespace {

using testing::kPatient;
using testing::SceneBuilder;
using testing::Swept;
using testing::operator*;

// The layer of a scene at height 0.5, and what is left of it.
class UncoveredLayer {
 public:
  explicit UncoveredLayer(csg::Scene scene) : scene_(std::move(scene)) {
    const ldni::LayerGrid grid = ldni::LayerGrid::at_heights({0.5});
    ldni::LeafSectioner(scene_, grid).cut(0, 1, block_);
    left_ = covered_.leave_out(block_.chains_of(0));
  }

  LayerChains whole() const { return block_.chains_of(0); }
  const LayerChains& left() const { return left_; }
  std::set<std::uint32_t> leaves_left() const {
    std::set<std::uint32_t> leaves;
    for (const Chain& chain : left_.chains) leaves.insert(chain.operand);
    return leaves;
  }
  bool has_left(std::uint32_t leaf) const {
    return leaves_left().contains(leaf);
  }

  Contours sweep(const LayerChains& layer) const {
    return testing::sweep(scene_, {&layer, 1}, kPatient).layers[0];
  }

 private:
  csg::Scene scene_;
  BooleanProgram program_ = csg::program_of(scene_);
  ldni::SectionBlock block_;
  CoveredLeaves covered_{program_};
  LayerChains left_;
};

void expect_same_region(const UncoveredLayer& layer) {
  const Contours whole = layer.sweep(layer.whole());
  const Contours left = layer.sweep(layer.left());
  EXPECT_EQ(support::count_loops(left), support::count_loops(whole));
  EXPECT_NEAR(support::total_area(left), support::total_area(whole), 1e-9);
}

void add_square(SceneBuilder& builder, const Vec2& corner, double size) {
  builder.add(testing::cube_leaf({size, size, 1}),
              testing::translated({corner.x, corner.y, 0}));
}

// Far from all else, so that an operator has leaves enough to be looked at.
void add_others(SceneBuilder& builder) {
  for (int i = 0; i < 20; ++i) add_square(builder, {100.0 + 2 * i, 0}, 1);
}

TEST(CoveredLeaves, ALeafWithinAnotherGoes) {
  SceneBuilder builder;
  add_square(builder, {0, 0}, 50);
  add_square(builder, {10, 10}, 20);
  add_others(builder);
  const UncoveredLayer layer(builder.finish());
  EXPECT_TRUE(layer.has_left(0));
  EXPECT_FALSE(layer.has_left(1));
  EXPECT_EQ(layer.leaves_left().size(), 21U);
  expect_same_region(layer);
}

TEST(CoveredLeaves, ALeafWithinSeveralGoes) {
  SceneBuilder builder;
  for (int i = 0; i < 4; ++i) add_square(builder, {20.0 * i, 0}, 30);
  add_square(builder, {25, 2}, 25);
  add_others(builder);
  const UncoveredLayer layer(builder.finish());
  EXPECT_EQ(layer.leaves_left().size(), 24U);
  EXPECT_FALSE(layer.has_left(4));
}

TEST(CoveredLeaves, WhatReachesTheBorderStays) {
  for (const double gap : {-0.1, 0.0, 0.1 * kTieDistance, kTieDistance}) {
    SceneBuilder builder;
    add_square(builder, {0, 0}, 50);
    add_square(builder, {gap, 10}, 20);
    add_others(builder);
    EXPECT_TRUE(UncoveredLayer(builder.finish()).has_left(1)) << gap;
  }
}

TEST(CoveredLeaves, OfEqualLeavesNoneCoversAnother) {
  SceneBuilder builder;
  for (int i = 0; i < 40; ++i) add_square(builder, {0, 0}, 10);
  EXPECT_EQ(UncoveredLayer(builder.finish()).leaves_left().size(), 40U);
}

TEST(CoveredLeaves, AHoleCoversNothing) {
  SceneBuilder builder;
  builder.add(testing::torus_leaf(30, 10, 60, 24),
              testing::translated({40, 40, 0.5}));
  add_square(builder, {35, 35}, 10);
  add_others(builder);
  EXPECT_TRUE(UncoveredLayer(builder.finish()).has_left(1));
}

TEST(CoveredLeaves, WhatAUnionHoldsBelowAnotherOperatorGoes) {
  SceneBuilder builder;
  add_square(builder, {0, 0}, 50);
  builder.begin(BooleanOp::kDifference);
  add_square(builder, {10, 10}, 20);
  add_square(builder, {12, 12}, 60);  // sticks out, but only the minuend counts
  builder.end();
  add_others(builder);
  const UncoveredLayer layer(builder.finish());
  EXPECT_FALSE(layer.has_left(1));
  EXPECT_TRUE(layer.has_left(2));
  expect_same_region(layer);
}

TEST(CoveredLeaves, WhatIsSubtractedCoversAllOfTheDifference) {
  SceneBuilder builder(BooleanOp::kDifference);
  add_square(builder, {10, 10}, 20);  // nothing is left of it
  add_square(builder, {0, 0}, 25);
  add_square(builder, {20, 0}, 25);
  add_square(builder, {0, 20}, 25);
  add_square(builder, {20, 20}, 25);
  for (int i = 0; i < 20; ++i) add_square(builder, {12.0 + 0.7 * i, 15}, 0.5);
  EXPECT_EQ(UncoveredLayer(builder.finish()).leaves_left(),
            (std::set<std::uint32_t>{1, 2, 3, 4}));
}

TEST(CoveredLeaves, AMinuendAndAnIntersectionCoverNothing) {
  SceneBuilder difference(BooleanOp::kDifference);
  add_square(difference, {0, 0}, 50);
  add_square(difference, {10, 10}, 20);
  add_others(difference);
  EXPECT_TRUE(UncoveredLayer(difference.finish()).has_left(1));

  SceneBuilder intersection(BooleanOp::kIntersection);
  for (int i = 0; i < 30; ++i) {
    add_square(intersection, {0.5 * i, 0.5 * i}, 50.0 - i);
  }
  EXPECT_EQ(UncoveredLayer(intersection.finish()).leaves_left().size(), 30U);
}

// Balls and turned bricks of all sizes in each other, some of them pierced.
csg::Scene heap(std::uint64_t seed, BooleanOp root) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto place = [&] {
    return testing::translated(
        {20 * unit(random), 20 * unit(random), unit(random)});
  };
  const auto add_ball = [&](SceneBuilder& builder) {
    const double radius = 0.2 + 5 * unit(random) * unit(random);
    builder.add(testing::sphere_leaf(radius, 12), place());
  };
  const auto add_brick = [&](SceneBuilder& builder) {
    const double size = 0.2 + 8 * unit(random) * unit(random);
    builder.add(testing::cube_leaf({size, size / 2, size}),
                place() * testing::rotated(360 * unit(random), {1, 1, 1}));
  };
  SceneBuilder builder(root);
  for (int i = 0; i < 120; ++i) {
    switch (random() % 4) {
      case 0:
        add_brick(builder);
        break;
      case 1:
        builder.begin(BooleanOp::kDifference);
        add_ball(builder);
        add_brick(builder);
        add_ball(builder);
        builder.end();
        break;
      default:
        add_ball(builder);
    }
  }
  return builder.finish();
}

TEST(CoveredLeaves, LeavingThemOutChangesNoRegion) {
  std::size_t all = 0;
  std::size_t left = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const UncoveredLayer layer(
        heap(seed, seed % 2 == 0 ? BooleanOp::kUnion : BooleanOp::kDifference));
    expect_same_region(layer);
    all += layer.whole().chains.size();
    left += layer.left().chains.size();
  }
  EXPECT_LT(left, all - all / 5);
}

}  // namespace
}  // namespace lamina::plane
