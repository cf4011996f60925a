#include "csg/program_state.h"

#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/csg/random_program.h"

namespace lamina::csg {
namespace {

// The definition of the three operators, evaluated from scratch.
bool evaluate(const Scene& scene, const std::vector<bool>& inside) {
  std::vector<std::vector<bool>> minuends(scene.program.size());
  std::vector<std::vector<bool>> others(scene.program.size());
  const auto note = [&](std::uint32_t parent, bool is_minuend, bool value) {
    (is_minuend ? minuends : others)[parent].push_back(value);
  };
  for (std::size_t i = 0; i < inside.size(); ++i) {
    note(scene.instances[i].parent, scene.instances[i].is_minuend, inside[i]);
  }
  bool value = false;
  for (std::size_t n = scene.program.size(); n-- > 0;) {
    bool any = false;
    bool all = true;
    bool first = false;
    for (const bool child : minuends[n]) {
      any |= child;
      all &= child;
      first |= child;
    }
    bool any_other = false;
    for (const bool child : others[n]) {
      any |= child;
      all &= child;
      any_other |= child;
    }
    switch (scene.program[n].op) {
      case BooleanOp::kUnion:
        value = any;
        break;
      case BooleanOp::kIntersection:
        value = all;
        break;
      case BooleanOp::kDifference:
        value = first && !any_other;
        break;
    }
    if (n > 0)
      note(scene.program[n].parent, scene.program[n].is_minuend, value);
  }
  return value;
}

TEST(ProgramState, AgreesWithTheDefinitionOfTheOperatorsAfterEveryFlip) {
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    const Scene scene = random_program(random);
    ProgramState state(scene);
    std::vector<bool> inside(scene.instances.size(), false);
    EXPECT_FALSE(state.value());
    for (int step = 0; step < 60; ++step) {
      const auto i = static_cast<std::uint32_t>(random() % inside.size());
      inside[i] = !inside[i];
      state.flip(i, inside[i]);
      ASSERT_EQ(state.is_inside(i), inside[i]);
      ASSERT_EQ(state.value(), evaluate(scene, inside));
    }
  }
}

TEST(ProgramState, ResetGivesTheEmptySet) {
  std::mt19937 random(8);
  const Scene scene = random_program(random);
  ProgramState state(scene);
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
    state.flip(i, true);
  EXPECT_EQ(state.inside().size(), scene.instances.size());
  state.reset();
  EXPECT_TRUE(state.inside().empty());
  EXPECT_FALSE(state.value());
  state.flip(0, true);
  std::vector<bool> inside(scene.instances.size(), false);
  inside[0] = true;
  EXPECT_EQ(state.value(), evaluate(scene, inside));
}

TEST(ProgramState, AnEmptyProgramHoldsNowhere) {
  for (const BooleanOp op :
       {BooleanOp::kUnion, BooleanOp::kIntersection, BooleanOp::kDifference}) {
    Scene scene;
    scene.program.push_back({op, 0, false, 0});
    EXPECT_FALSE(ProgramState(scene).value());
  }
}

}  // namespace
}  // namespace lamina::csg
