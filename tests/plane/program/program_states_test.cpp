#include "plane/program/program_states.h"

#include <cstdint>
#include <map>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "csg/scene.h"
#include "tests/ldni/support/scene_builder.h"

namespace lamina::plane {
namespace {

using testing::SceneBuilder;
using Counts = std::vector<std::int32_t>;  // an instance
using State = ProgramStates::State;

csg::Leaf leaf(bool may_overlap_itself) {
  csg::Leaf cube = testing::cube_leaf({1, 1, 1});
  cube.may_overlap_itself = may_overlap_itself;
  return cube;
}

// The definition: the operators over leaves that contain the place or not.
class Definition {
 public:
  Definition(const csg::Scene& scene, FillRule rule)
      : scene_(scene), rule_(rule) {}

  bool is_solid(const Counts& counts) const { return holds(0, counts); }

 private:
  bool contains(std::uint32_t instance, const Counts& counts) const {
    const auto count = counts[instance];
    if (rule_ == FillRule::kEvenOdd) return (count & 1) != 0;
    return rule_ == FillRule::kNonZero ? count != 0 : count > 0;
  }
  bool holds(std::uint32_t node, const Counts& counts) const {
    bool is_any = false;
    bool are_all = true;
    bool is_minuend = false;
    bool is_subtrahend = false;
    const auto take = [&](bool value, bool is_first) {
      is_any = is_any || value;
      are_all = are_all && value;
      bool& side = is_first ? is_minuend : is_subtrahend;
      side = side || value;
    };
    for (std::uint32_t i = 1; i < scene_.program.size(); ++i) {
      const BooleanNode& child = scene_.program[i];
      if (child.parent == node) take(holds(i, counts), child.is_minuend);
    }
    for (std::uint32_t i = 0; i < scene_.instances.size(); ++i) {
      const csg::Instance& child = scene_.instances[i];
      if (child.parent == node) take(contains(i, counts), child.is_minuend);
    }
    switch (scene_.program[node].op) {
      case BooleanOp::kUnion:
        return is_any;
      case BooleanOp::kIntersection:
        return are_all;
      case BooleanOp::kDifference:
        return is_minuend && !is_subtrahend;
    }
    return false;
  }

  const csg::Scene& scene_;
  const FillRule rule_;
};

// (A + B - C) * (D - E); B and D may overlap themselves.
csg::Scene scene_of_five() {
  SceneBuilder builder(BooleanOp::kIntersection);
  builder.begin(BooleanOp::kDifference);
  builder.begin(BooleanOp::kUnion);
  builder.add(leaf(false));
  builder.add(leaf(true));
  builder.end();
  builder.add(leaf(false));
  builder.end();
  builder.begin(BooleanOp::kDifference);
  builder.add(leaf(true));
  builder.add(leaf(false));
  builder.end();
  return builder.finish();
}

// Passes chains at random, and keeps count of the leaves on the way.
class Walk {
 public:
  Walk(const csg::Scene& scene, ProgramStates& states, std::uint64_t seed)
      : scene_(scene),
        states_(states),
        random_(seed),
        counts_(scene.instances.size()) {}

  void step() {
    const auto instance =
        static_cast<std::uint32_t>(random_() % counts_.size());
    if (scene_.leaves[scene_.instances[instance].leaf].may_overlap_itself) {
      std::int32_t winding = random_() % 2 == 0 ? 1 : -1;
      if (counts_[instance] * winding == 2) winding = -winding;
      cross(instance, winding);
    } else {
      cross(instance, counts_[instance] == 0 ? 1 : -1);
    }
  }
  // Takes off what the counts have too much, leaf by leaf.
  void go_outside() {
    for (std::uint32_t i = 0; i < counts_.size(); ++i) {
      while (counts_[i] != 0) cross(i, counts_[i] > 0 ? -1 : 1);
    }
  }

  State& state() { return state_; }
  const Counts& counts() const { return counts_; }

 private:
  void cross(std::uint32_t instance, std::int32_t winding) {
    state_ =
        states_.state_above(state_, states_.crossing_of(instance, winding));
    counts_[instance] += winding;
  }

  const csg::Scene& scene_;
  ProgramStates& states_;
  std::mt19937_64 random_;
  State state_ = ProgramStates::kOutside;
  Counts counts_;
};

TEST(ProgramStates, AreSolidWhereTheOperatorsSaySo) {
  const csg::Scene scene = scene_of_five();
  for (const FillRule rule :
       {FillRule::kNonZero, FillRule::kPositive, FillRule::kEvenOdd}) {
    ProgramStates states(csg::program_of(scene), rule);
    const Definition definition(scene, rule);
    Walk walk(scene, states, 1);
    int solid = 0;
    for (int i = 0; i < 2000; ++i) {
      walk.step();
      const bool is_solid = definition.is_solid(walk.counts());
      ASSERT_EQ(states.is_solid(walk.state()), is_solid);
      solid += is_solid ? 1 : 0;
    }
    EXPECT_GT(solid, 100);
    EXPECT_LT(solid, 1900);
  }
}

TEST(ProgramStates, OfEqualCountsAreTheSame) {
  const csg::Scene scene = scene_of_five();
  ProgramStates states(csg::program_of(scene), FillRule::kNonZero);
  std::map<Counts, State> known;
  Walk walk(scene, states, 2);
  for (int i = 0; i < 5000; ++i) {
    walk.step();
    const auto [place, is_new] = known.try_emplace(walk.counts(), walk.state());
    ASSERT_EQ(place->second, walk.state());
  }
  // Eight sets of leaves that toggle, five counts of each of the others.
  EXPECT_EQ(known.size(), 8U * 5 * 5);
  walk.go_outside();
  EXPECT_EQ(walk.state(), ProgramStates::kOutside);
  // kOutside was there before.
  EXPECT_EQ(states.states_met(), 8U * 5 * 5 - 1);
}

// Leaves of one operator that cannot overlap themselves are only counted.
TEST(ProgramStates, AreAsManyAsAnOperatorHasSums) {
  constexpr std::uint32_t kLeaves = 40;
  for (const BooleanOp op :
       {BooleanOp::kUnion, BooleanOp::kIntersection, BooleanOp::kDifference}) {
    SceneBuilder builder(op);
    for (std::uint32_t i = 0; i < kLeaves; ++i) builder.add(leaf(false));
    const csg::Scene scene = builder.finish();
    ProgramStates states(csg::program_of(scene), FillRule::kNonZero);
    const Definition definition(scene, FillRule::kNonZero);
    Walk walk(scene, states, 4);
    for (int i = 0; i < 5000; ++i) {
      walk.step();
      ASSERT_EQ(states.is_solid(walk.state()),
                definition.is_solid(walk.counts()));
    }
    EXPECT_LE(states.states_met(), kLeaves);
  }
}

// A wide union of differences is a balanced tree of parts; a tower of
// differences is a deep one.
TEST(ProgramStates, OfWideAndOfDeepProgramsAreRight) {
  for (const bool is_deep : {false, true}) {
    SceneBuilder builder(BooleanOp::kUnion);
    constexpr int kParts = 21;
    for (int i = 0; i < kParts; ++i) {
      builder.begin(i % 3 == 2 ? BooleanOp::kIntersection
                               : BooleanOp::kDifference);
      builder.add(leaf(i % 4 == 1));
      if (!is_deep) {
        builder.add(leaf(false));
        builder.end();
      }
    }
    for (int i = 0; is_deep && i < kParts; ++i) {
      builder.add(leaf(false));
      builder.end();
    }
    const csg::Scene scene = builder.finish();
    ProgramStates states(csg::program_of(scene), FillRule::kNonZero);
    const Definition definition(scene, FillRule::kNonZero);
    Walk walk(scene, states, 5);
    for (int i = 0; i < 3000; ++i) {
      walk.step();
      ASSERT_EQ(states.is_solid(walk.state()),
                definition.is_solid(walk.counts()));
    }
    walk.go_outside();
    EXPECT_EQ(walk.state(), ProgramStates::kOutside);
  }
}

// Adds an operator with two to four operands, half of them operators as long as
// there is depth left.
void add_random_operator(int depth, std::mt19937& random,
                         SceneBuilder& builder) {
  const auto count = 2 + random() % 3;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (depth == 0 || random() % 2 == 0) {
      builder.add(leaf(random() % 4 == 0));
      continue;
    }
    builder.begin(static_cast<BooleanOp>(random() % 3));
    add_random_operator(depth - 1, random, builder);
    builder.end();
  }
}

TEST(ProgramStates, OfRandomProgramsAreRight) {
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    std::mt19937 random(seed);
    SceneBuilder builder(static_cast<BooleanOp>(seed % 3));
    add_random_operator(7, random, builder);
    const csg::Scene scene = builder.finish();
    ProgramStates states(csg::program_of(scene), FillRule::kNonZero);
    const Definition definition(scene, FillRule::kNonZero);
    Walk walk(scene, states, seed);
    for (int i = 0; i < 300; ++i) {
      walk.step();
      ASSERT_EQ(states.is_solid(walk.state()),
                definition.is_solid(walk.counts()))
          << seed;
    }
    walk.go_outside();
    EXPECT_EQ(walk.state(), ProgramStates::kOutside) << seed;
  }
}

// A - (B - (C - …)): within the first k leaves it is solid where k is odd. A
// state's number tells how many cells were made before.
TEST(ProgramStates, OfDifferencesInDifferencesTakeFewCells) {
  constexpr std::uint32_t kLeaves = 4096;
  constexpr std::uint32_t kCellsForEach = 13;  // 1 + log2(kLeaves)
  SceneBuilder builder(BooleanOp::kDifference);
  for (std::uint32_t i = 0; i < kLeaves; ++i) {
    builder.add(leaf(false));
    if (i + 2 < kLeaves) builder.begin(BooleanOp::kDifference);
  }
  for (std::uint32_t i = 0; i + 2 < kLeaves; ++i) builder.end();
  const csg::Scene scene = builder.finish();
  ProgramStates states(csg::program_of(scene), FillRule::kNonZero);
  State state = ProgramStates::kOutside;
  for (std::uint32_t i = 0; i < kLeaves; ++i) {
    state = states.state_above(state, states.crossing_of(i, 1));
    ASSERT_EQ(states.is_solid(state), i % 2 == 0);
  }
  EXPECT_LE(state, kCellsForEach * kLeaves);
}

TEST(ProgramStates, ThatAreKeptStandForTheSameAsBefore) {
  const csg::Scene scene = scene_of_five();
  ProgramStates states(csg::program_of(scene), FillRule::kNonZero);
  const Definition definition(scene, FillRule::kNonZero);
  std::vector<Walk> walks;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    walks.emplace_back(scene, states, seed);
  }
  for (int round = 0; round < 20; ++round) {
    for (Walk& walk : walks) {
      for (int i = 0; i < 50; ++i) walk.step();
    }
    std::vector<State*> live;
    for (Walk& walk : walks) live.push_back(&walk.state());
    states.keep_only(live);
    for (Walk& walk : walks) {
      // At most eight parts below the root of scene_of_five.
      EXPECT_LE(walk.state(), 9 * walks.size());
      EXPECT_EQ(states.is_solid(walk.state()),
                definition.is_solid(walk.counts()));
    }
  }
  for (Walk& walk : walks) {
    walk.go_outside();
    EXPECT_EQ(walk.state(), ProgramStates::kOutside);
  }
}

}  // namespace
}  // namespace lamina::plane
