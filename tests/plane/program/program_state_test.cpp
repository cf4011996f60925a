#include "plane/program/program_state.h"

#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/plane/program/random_program.h"

namespace lamina::plane {
namespace {

// The definition of the three operators, evaluated from scratch.
bool evaluate(const BooleanProgram& program, const std::vector<bool>& inside) {
  std::vector<std::vector<bool>> minuends(program.nodes.size());
  std::vector<std::vector<bool>> others(program.nodes.size());
  const auto note = [&](std::uint32_t parent, bool is_minuend, bool value) {
    (is_minuend ? minuends : others)[parent].push_back(value);
  };
  for (std::size_t i = 0; i < inside.size(); ++i) {
    note(program.operands[i].parent, program.operands[i].is_minuend, inside[i]);
  }
  bool value = false;
  for (std::size_t n = program.nodes.size(); n-- > 0;) {
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
    switch (program.nodes[n].op) {
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
      note(program.nodes[n].parent, program.nodes[n].is_minuend, value);
  }
  return value;
}

TEST(ProgramState, AgreesWithTheDefinitionOfTheOperatorsAfterEveryFlip) {
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    const BooleanProgram program = random_program(random);
    ProgramState state(program);
    std::vector<bool> inside(program.operands.size(), false);
    EXPECT_FALSE(state.value());
    for (int step = 0; step < 60; ++step) {
      const auto i = static_cast<std::uint32_t>(random() % inside.size());
      inside[i] = !inside[i];
      state.flip(i, inside[i]);
      ASSERT_EQ(state.is_inside(i), inside[i]);
      ASSERT_EQ(state.value(), evaluate(program, inside));
    }
  }
}

TEST(ProgramState, ResetGivesTheEmptySet) {
  std::mt19937 random(8);
  const BooleanProgram program = random_program(random);
  ProgramState state(program);
  for (std::uint32_t i = 0; i < program.operands.size(); ++i)
    state.flip(i, true);
  EXPECT_EQ(state.inside().size(), program.operands.size());
  state.reset();
  EXPECT_TRUE(state.inside().empty());
  EXPECT_FALSE(state.value());
  state.flip(0, true);
  std::vector<bool> inside(program.operands.size(), false);
  inside[0] = true;
  EXPECT_EQ(state.value(), evaluate(program, inside));
}

TEST(ProgramState, AnEmptyProgramHoldsNowhere) {
  for (const BooleanOp op :
       {BooleanOp::kUnion, BooleanOp::kIntersection, BooleanOp::kDifference}) {
    BooleanProgram program;
    program.nodes.push_back({op, 0, false, 0});
    EXPECT_FALSE(ProgramState(program).value());
  }
}

}  // namespace
}  // namespace lamina::plane
