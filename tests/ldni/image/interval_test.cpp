// Laws of sets, kept by the intervals of a ray. Depths are whole numbers or
// anywhere, so that the operands share end points often or never.

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "ldni/image/boolean.h"
#include "ldni/image/sample.h"
#include "plane/tie_distance.h"
#include "tests/support/leaf_scenes.h"

namespace lamina::ldni {
namespace {

using plane::BooleanOp;
using Intervals = std::vector<Interval>;

constexpr BooleanOp kUnion = BooleanOp::kUnion;
constexpr BooleanOp kIntersection = BooleanOp::kIntersection;
constexpr BooleanOp kDifference = BooleanOp::kDifference;

// Intervals of a ray as those of a leaf, combined with others.
Intervals combine(BooleanOp op, const std::vector<Intervals>& operands) {
  csg::Scene scene = support::scene_of(op);
  scene.leaves.resize(1);
  std::vector<Sample> samples;
  for (const Intervals& operand : operands) {
    const std::uint32_t leaf = support::place_leaf(scene, 0, Affine(1.0));
    for (const Interval& interval : operand) {
      samples.push_back(interval.enter);
      samples.push_back(interval.exit);
      samples[samples.size() - 2].instance = leaf;
      samples[samples.size() - 1].instance = leaf;
    }
  }
  Intervals result;
  RayBoolean(scene).evaluate(samples, result);
  return result;
}

double length(const Intervals& intervals) {
  double sum = 0;
  for (const Interval& interval : intervals) sum += interval.length();
  return sum;
}

std::vector<double> depths(const Intervals& intervals) {
  std::vector<double> result;
  for (const Interval& interval : intervals) {
    result.push_back(interval.enter.depth);
    result.push_back(interval.exit.depth);
  }
  return result;
}

class IntervalLaws : public ::testing::TestWithParam<bool> {
 protected:
  static constexpr double kLow = -20;
  static constexpr double kHigh = 20;

  // Up to six disjoint intervals strictly inside of (kLow, kHigh).
  Intervals random_intervals() {
    std::vector<double> ends(2 * (random_() % 7));
    for (double& end : ends) {
      end = GetParam()
                ? static_cast<double>(random_() % 31) - 15
                : std::uniform_real_distribution<double>(-15, 15)(random_);
    }
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    Intervals intervals;
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
      intervals.push_back(make_interval(ends[i], ends[i + 1]));
    }
    return intervals;
  }
  static Interval make_interval(double enter, double exit) {
    Interval interval;
    interval.enter.depth = enter;
    interval.exit.depth = exit;
    interval.exit.normal = glm::vec3(0, 1, 0);
    return interval;
  }
  static Intervals complement(const Intervals& of) {
    return combine(kDifference, {{make_interval(kLow, kHigh)}, of});
  }

  template <typename Law>
  void for_random_intervals(const Law& law) {
    for (int round = 0; round < 1000; ++round) {
      law(random_intervals(), random_intervals(), random_intervals());
      if (HasFatalFailure()) return;
    }
  }

 private:
  std::mt19937 random_{21};
};

TEST_P(IntervalLaws, AscendWithoutTouching) {
  for_random_intervals([](const auto& a, const auto& b, const auto& c) {
    for (const BooleanOp op : {kUnion, kIntersection, kDifference}) {
      const std::vector<double> ends = depths(combine(op, {a, b, c}));
      for (std::size_t i = 1; i < ends.size(); ++i) {
        ASSERT_GT(ends[i], ends[i - 1] + kTieDistance);
      }
    }
  });
}

TEST_P(IntervalLaws, UnionAndIntersectionHaveTheLengthOfBothOperands) {
  for_random_intervals([](const auto& a, const auto& b, const auto&) {
    ASSERT_NEAR(length(combine(kUnion, {a, b})) +
                    length(combine(kIntersection, {a, b})),
                length(a) + length(b), 1e-12);
  });
}

TEST_P(IntervalLaws, OperandsMayChangePlaces) {
  for_random_intervals([](const auto& a, const auto& b, const auto& c) {
    for (const BooleanOp op : {kUnion, kIntersection}) {
      ASSERT_EQ(depths(combine(op, {a, b, c})), depths(combine(op, {c, a, b})));
    }
    ASSERT_EQ(depths(combine(kDifference, {a, b, c})),
              depths(combine(kDifference, {a, c, b})));
  });
}

TEST_P(IntervalLaws, OperandsMayBeGrouped) {
  for_random_intervals([](const auto& a, const auto& b, const auto& c) {
    for (const BooleanOp op : {kUnion, kIntersection}) {
      ASSERT_EQ(depths(combine(op, {a, b, c})),
                depths(combine(op, {a, combine(op, {b, c})})));
    }
    ASSERT_EQ(depths(combine(kDifference, {a, b, c})),
              depths(combine(kDifference, {a, combine(kUnion, {b, c})})));
  });
}

TEST_P(IntervalLaws, IntersectionDistributesOverUnion) {
  for_random_intervals([](const auto& a, const auto& b, const auto& c) {
    ASSERT_EQ(depths(combine(kIntersection, {a, combine(kUnion, {b, c})})),
              depths(combine(kUnion, {combine(kIntersection, {a, b}),
                                      combine(kIntersection, {a, c})})));
  });
}

TEST_P(IntervalLaws, ComplementTurnsUnionIntoIntersection) {
  for_random_intervals([](const auto& a, const auto& b, const auto&) {
    ASSERT_EQ(depths(complement(combine(kUnion, {a, b}))),
              depths(combine(kIntersection, {complement(a), complement(b)})));
    ASSERT_EQ(depths(complement(complement(a))), depths(a));
  });
}

TEST_P(IntervalLaws, OperandsCombineWithThemselves) {
  for_random_intervals([](const auto& a, const auto&, const auto&) {
    ASSERT_EQ(depths(combine(kUnion, {a, a})), depths(a));
    ASSERT_EQ(depths(combine(kIntersection, {a, a})), depths(a));
    ASSERT_TRUE(combine(kDifference, {a, a}).empty());
  });
}

INSTANTIATE_TEST_SUITE_P(SharedEndPoints, IntervalLaws, ::testing::Bool());

TEST(LayerIntervals, GiveTheIntervalsOfEachRay) {
  LayerIntervals layer;
  layer.intervals.resize(3);
  layer.ends = {0, 2, 2, 3};
  ASSERT_EQ(layer.ray_count(), 4U);
  EXPECT_TRUE(layer.ray(0).empty());
  EXPECT_EQ(layer.ray(1).size(), 2U);
  EXPECT_TRUE(layer.ray(2).empty());
  EXPECT_EQ(layer.ray(3).data(), &layer.intervals[2]);
}

}  // namespace
}  // namespace lamina::ldni
