#include "ldni/image/boolean.h"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "base/diagnostic.h"
#include "plane/tie_distance.h"
#include "tests/ldni/image/ray_reference.h"
#include "tests/support/leaf_scenes.h"

namespace lamina::ldni {
namespace {

using csg::Scene;
using plane::BooleanOp;

Sample make_sample(double depth, std::uint32_t instance, bool is_entry) {
  return {depth, glm::vec3(0.6F, is_entry ? -0.8F : 0.8F, 0), instance};
}

// A scene of `count` leaves without geometry under one operator.
Scene operands(BooleanOp op, int count, bool may_overlap_itself = false) {
  Scene scene = support::scene_of(op);
  scene.leaves.resize(1);
  scene.leaves[0].may_overlap_itself = may_overlap_itself;
  for (int i = 0; i < count; ++i) support::place_leaf(scene, 0, Affine(1.0));
  return scene;
}

void add_samples(std::vector<Sample>& samples, std::uint32_t instance,
                 const Ranges& ranges) {
  for (const Range& range : ranges) {
    samples.push_back(make_sample(range.enter, instance, true));
    samples.push_back(make_sample(range.exit, instance, false));
  }
}

std::vector<Interval> evaluate(
    const Scene& scene,
    // cppcheck-suppress passedByValue ; sorted in place
    std::vector<Sample> samples) {
  std::vector<Interval> intervals;
  RayBoolean(scene).evaluate(samples, intervals);
  return intervals;
}

Ranges ranges_of(const std::vector<Interval>& intervals) {
  Ranges ranges;
  ranges.reserve(intervals.size());
  for (const Interval& interval : intervals) {
    ranges.push_back({interval.enter.depth, interval.exit.depth});
  }
  return ranges;
}

Ranges evaluate_two(BooleanOp op, const Ranges& a, const Ranges& b) {
  std::vector<Sample> samples;
  add_samples(samples, 0, a);
  add_samples(samples, 1, b);
  return ranges_of(evaluate(operands(op, 2), samples));
}

// --- Section 4.2 of Zeng et al. 2011 ----------------------------------------

bool is_inside(double depth, const Ranges& ranges) {
  return std::any_of(ranges.begin(), ranges.end(), [&](const Range& range) {
    return range.enter <= depth && depth < range.exit;
  });
}

// The end points of A and B that survive, ascending: for A ∪ B those of each
// outside of the other, for A ∩ B those inside, for A − B those of A outside
// of B and those of B inside of A. No end points coincide.
Ranges classify(BooleanOp op, const Ranges& a, const Ranges& b) {
  const bool keeps_a_inside = op == BooleanOp::kIntersection;
  const bool keeps_b_inside = op != BooleanOp::kUnion;
  std::vector<double> kept;
  const auto keep = [&](const Ranges& from, const Ranges& other, bool inside) {
    for (const Range& range : from) {
      for (const double depth : {range.enter, range.exit}) {
        if (is_inside(depth, other) == inside) kept.push_back(depth);
      }
    }
  };
  keep(a, b, keeps_a_inside);
  keep(b, a, keeps_b_inside);
  std::sort(kept.begin(), kept.end());
  Ranges result;
  for (std::size_t i = 0; i + 1 < kept.size(); i += 2) {
    result.push_back({kept[i], kept[i + 1]});
  }
  return result;
}

// Up to five disjoint ranges with ends anywhere.
Ranges random_ranges(std::mt19937& random) {
  std::vector<double> depths(2 * (random() % 6));
  std::uniform_real_distribution<double> depth(-10, 10);
  for (double& d : depths) d = depth(random);
  std::sort(depths.begin(), depths.end());
  Ranges ranges;
  for (std::size_t i = 0; i < depths.size(); i += 2) {
    ranges.push_back({depths[i], depths[i + 1]});
  }
  return ranges;
}

TEST(EvaluateRay, KeepsTheEndPointsThatThePaperKeepsForTwoOperands) {
  std::mt19937 random(4);
  for (int round = 0; round < 20000; ++round) {
    const Ranges a = random_ranges(random);
    const Ranges b = random_ranges(random);
    for (const BooleanOp op : {BooleanOp::kUnion, BooleanOp::kIntersection,
                               BooleanOp::kDifference}) {
      ASSERT_EQ(evaluate_two(op, a, b), classify(op, a, b));
    }
  }
}

// --- Many operands and ties -------------------------------------------------

// A random program over leaves without geometry.
Scene random_scene(std::mt19937& random) {
  const auto any_operator = [&] {
    return static_cast<BooleanOp>(random() % 3);
  };
  Scene scene = support::scene_of(any_operator());
  scene.leaves.resize(2);
  scene.leaves[1].may_overlap_itself = true;
  const auto operators = random() % 5;
  for (unsigned i = 0; i < operators; ++i) {
    support::add_operator(
        scene, any_operator(),
        static_cast<std::uint32_t>(random() % scene.program.size()));
  }
  for (std::uint32_t i = 0; i < scene.program.size(); ++i) {
    const auto leaves =
        (scene.program[i].child_count == 0 ? 1 : 0) + random() % 3;
    for (unsigned k = 0; k < leaves; ++k) {
      support::place_leaf(scene, random() % 2, Affine(1.0), i);
    }
  }
  return scene;
}

// Depths are whole numbers, so that ties abound. A leaf's ranges may touch, and
// overlap where the leaf may. Gives the samples and fills in, cell by cell,
// which leaves cover [cell, cell + 1).
constexpr std::size_t kCells = 12;
std::vector<Sample> random_samples(const Scene& scene, std::mt19937& random,
                                   std::vector<std::vector<bool>>& covered) {
  std::vector<Sample> samples;
  covered.assign(kCells, std::vector<bool>(scene.instances.size(), false));
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const bool may_overlap =
        scene.leaves[scene.instances[i].leaf].may_overlap_itself;
    std::size_t least = 0;
    for (unsigned k = 0; k < 1 + random() % 3 && least < kCells; ++k) {
      const std::size_t enter = least + random() % (kCells - least);
      const std::size_t exit = enter + 1 + random() % (kCells - enter);
      add_samples(samples, i,
                  {{static_cast<double>(enter), static_cast<double>(exit)}});
      for (std::size_t cell = enter; cell < exit; ++cell) {
        covered[cell][i] = true;
      }
      least = may_overlap ? 0 : exit;
    }
  }
  return samples;
}

Ranges evaluate_cells(const Scene& scene,
                      const std::vector<std::vector<bool>>& covered) {
  Ranges result;
  for (std::size_t cell = 0; cell < kCells; ++cell) {
    if (!support::evaluate_program(scene, covered[cell])) continue;
    const auto depth = static_cast<double>(cell);
    if (!result.empty() && result.back().exit == depth) {
      result.back().exit = depth + 1;
    } else {
      result.push_back({depth, depth + 1});
    }
  }
  return result;
}

TEST(EvaluateRay, EqualsTheProgramCellByCellHoweverManySamplesTie) {
  std::mt19937 random(11);
  for (int round = 0; round < 5000; ++round) {
    const Scene scene = random_scene(random);
    std::vector<std::vector<bool>> covered;
    const std::vector<Sample> samples = random_samples(scene, random, covered);
    ASSERT_EQ(ranges_of(evaluate(scene, samples)),
              evaluate_cells(scene, covered))
        << "round " << round;
  }
}

TEST(EvaluateRay, IgnoresDifferencesBelowTheTieDistance) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> noise(-0.01 * kTieDistance,
                                               0.01 * kTieDistance);
  for (int round = 0; round < 2000; ++round) {
    const Scene scene = random_scene(random);
    std::vector<std::vector<bool>> covered;
    std::vector<Sample> samples = random_samples(scene, random, covered);
    for (Sample& sample : samples) sample.depth += noise(random);
    Ranges ranges = ranges_of(evaluate(scene, samples));
    for (Range& range : ranges) {
      range = {std::round(range.enter), std::round(range.exit)};
    }
    ASSERT_EQ(ranges, evaluate_cells(scene, covered)) << "round " << round;
  }
}

TEST(EvaluateRay, DoesNotDependOnTheOrderOfTheSamples) {
  std::mt19937 random(13);
  for (int round = 0; round < 500; ++round) {
    const Scene scene = random_scene(random);
    std::vector<std::vector<bool>> covered;
    std::vector<Sample> samples = random_samples(scene, random, covered);
    const std::vector<Interval> expected = evaluate(scene, samples);
    std::shuffle(samples.begin(), samples.end(), random);
    const std::vector<Interval> shuffled = evaluate(scene, samples);
    ASSERT_EQ(shuffled.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      ASSERT_EQ(shuffled[i].enter.depth, expected[i].enter.depth);
      ASSERT_EQ(shuffled[i].exit.depth, expected[i].exit.depth);
      ASSERT_EQ(shuffled[i].enter.instance, expected[i].enter.instance);
      ASSERT_EQ(shuffled[i].exit.instance, expected[i].exit.instance);
    }
  }
}

// --- Single rules -----------------------------------------------------------

TEST(EvaluateRay, UnitesSolidsThatTouchWithoutAnInnerWall) {
  EXPECT_EQ(evaluate_two(BooleanOp::kUnion, {{0, 1}}, {{1, 2}}),
            (Ranges{{0, 2}}));
  EXPECT_EQ(evaluate_two(BooleanOp::kUnion, {{0, 1 + 4e-7}}, {{1, 2}}),
            (Ranges{{0, 2}}));
  EXPECT_EQ(evaluate_two(BooleanOp::kUnion, {{0, 1 - 4e-7}}, {{1, 2}}),
            (Ranges{{0, 2}}));
  EXPECT_EQ(evaluate_two(BooleanOp::kUnion, {{0, 1 - 4e-6}}, {{1, 2}}).size(),
            2U);
}

TEST(EvaluateRay, DifferenceWithCoplanarFacesLeavesNoSkin) {
  EXPECT_EQ(evaluate_two(BooleanOp::kDifference, {{0, 3}}, {{0, 3}}), Ranges{});
  EXPECT_EQ(evaluate_two(BooleanOp::kDifference, {{0, 3}}, {{4e-7, 3 - 4e-7}}),
            Ranges{});
  EXPECT_EQ(evaluate_two(BooleanOp::kDifference, {{0, 3}}, {{2, 3}}),
            (Ranges{{0, 2}}));
}

TEST(EvaluateRay, IntersectionOfSolidsThatTouchIsEmpty) {
  EXPECT_EQ(evaluate_two(BooleanOp::kIntersection, {{0, 1}}, {{1, 2}}),
            Ranges{});
}

TEST(EvaluateRay, DifferenceFlipsTheNormalOfTheSubtrahend) {
  std::vector<Sample> samples;
  add_samples(samples, 0, {{0, 10}});
  add_samples(samples, 1, {{4, 6}});
  const std::vector<Interval> intervals =
      evaluate(operands(BooleanOp::kDifference, 2), samples);
  ASSERT_EQ(intervals.size(), 2U);
  EXPECT_EQ(intervals[0].enter.normal, glm::vec3(0.6F, -0.8F, 0));
  EXPECT_EQ(intervals[0].exit.instance, 1U);
  EXPECT_EQ(intervals[0].exit.normal, glm::vec3(-0.6F, 0.8F, 0));
  EXPECT_EQ(intervals[1].enter.instance, 1U);
  EXPECT_EQ(intervals[1].enter.normal, glm::vec3(-0.6F, -0.8F, 0));
  EXPECT_EQ(intervals[1].exit.instance, 0U);
  EXPECT_EQ(intervals[1].exit.normal, glm::vec3(0.6F, 0.8F, 0));
}

TEST(EvaluateRay, NormalsPointOutOfTheSolidInRandomPrograms) {
  std::mt19937 random(14);
  for (int round = 0; round < 1000; ++round) {
    const Scene scene = random_scene(random);
    std::vector<std::vector<bool>> covered;
    for (const Interval& interval :
         evaluate(scene, random_samples(scene, random, covered))) {
      ASSERT_TRUE(interval.enter.is_entry());
      ASSERT_FALSE(interval.exit.is_entry());
      ASSERT_GT(interval.length(), kTieDistance);
    }
  }
}

TEST(EvaluateRay, CountsWindingsOfALeafThatOverlapsItself) {
  std::vector<Sample> samples;
  add_samples(samples, 0, {{0, 5}, {3, 8}, {3, 4}});
  EXPECT_EQ(ranges_of(evaluate(operands(BooleanOp::kUnion, 1, true), samples)),
            (Ranges{{0, 8}}));
}

TEST(EvaluateRay, InsideOutPartsOfALeafThatOverlapsItselfAreSolidToo) {
  std::vector<Sample> samples;
  add_samples(samples, 0, {{0, 2}});
  samples.push_back(make_sample(5, 0, false));
  samples.push_back(make_sample(7, 0, true));
  EXPECT_EQ(ranges_of(evaluate(operands(BooleanOp::kUnion, 1, true), samples)),
            (Ranges{{0, 2}, {5, 7}}));
}

TEST(EvaluateRay, AppendsRayAfterRay) {
  const Scene scene = operands(BooleanOp::kUnion, 1);
  RayBoolean boolean(scene);
  std::vector<Interval> intervals;
  std::vector<Sample> samples;
  boolean.evaluate(samples, intervals);
  add_samples(samples, 0, {{0, 1}});
  boolean.evaluate(samples, intervals);
  boolean.evaluate(samples, intervals);
  EXPECT_EQ(ranges_of(intervals), (Ranges{{0, 1}, {0, 1}}));
}

TEST(EvaluateRay, ALeafThatIsNeverLeftIsABrokenPromise) {
  std::vector<Sample> samples = {make_sample(0, 0, true)};
  EXPECT_THROW(evaluate(operands(BooleanOp::kUnion, 1), samples),
               InternalError);
}

}  // namespace
}  // namespace lamina::ldni
