#include "plane/cascade/difference_levels.h"

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "plane/program/boolean_program.h"
#include "plane/program/program_state.h"

namespace lamina::plane {
namespace {

void add_operands(BooleanProgram& program, std::uint32_t parent, int count,
                  bool has_minuend) {
  for (int i = 0; i < count; ++i) {
    program.operands.push_back({{}, parent, has_minuend && i == 0, false});
    ++program.nodes[parent].child_count;
  }
}

std::uint32_t add_node(BooleanProgram& program, BooleanOp op,
                       std::uint32_t parent, bool is_minuend = false) {
  program.nodes.push_back({op, parent, is_minuend, 0});
  ++program.nodes[parent].child_count;
  return static_cast<std::uint32_t>(program.nodes.size() - 1);
}

// Differences in each other. The minuend is an operand or an operator, and some
// levels subtract more: operands, a union, or a difference that leads nowhere.
BooleanProgram random_levels(std::mt19937& numbers, int levels) {
  BooleanProgram program{{{BooleanOp::kDifference, 0, false, 0}}, {}};
  std::uint32_t level = 0;
  for (int i = 0; i < levels; ++i) {
    if (numbers() % 2 == 0) {
      add_operands(program, level, 1, true);
    } else {
      add_operands(program,
                   add_node(program, BooleanOp::kIntersection, level, true), 2,
                   false);
    }
    const std::uint32_t upper = level;
    if (numbers() % 4 == 0) {
      add_operands(program, add_node(program, BooleanOp::kDifference, upper), 2,
                   true);
    }
    if (i + 1 < levels) {
      level = add_node(program, BooleanOp::kDifference, upper);
    }
    if (numbers() % 4 == 0) add_operands(program, upper, 1, false);
    if (numbers() % 4 == 0) {
      add_operands(program, add_node(program, BooleanOp::kUnion, upper), 2,
                   false);
    }
  }
  return program;
}

// A place is in the result where an odd number of levels, from the outermost
// on, hold before one that does not.
TEST(DifferenceLevels, DecideTheProgramByTheFirstThatDoesNotHold) {
  std::mt19937 numbers(1);
  for (int trial = 0; trial < 200; ++trial) {
    const int count = 1 + trial % 9;
    const BooleanProgram program = random_levels(numbers, count);
    const DifferenceLevels levels = difference_levels(program);
    ASSERT_GE(levels.programs.size(), static_cast<std::size_t>(count));
    ASSERT_EQ(levels.places.size(), program.operands.size());
    for (int set = 0; set < 100; ++set) {
      ProgramState whole(program);
      std::vector<ProgramState> states;
      for (const BooleanProgram& level : levels.programs) {
        states.emplace_back(level);
      }
      for (std::uint32_t i = 0; i < program.operands.size(); ++i) {
        if (numbers() % 5 == 0) continue;
        whole.flip(i, true);
        const auto [level, number] = levels.places[i];
        states[level].flip(number, true);
      }
      std::size_t depth = 0;
      while (depth < states.size() && states[depth].value()) ++depth;
      EXPECT_EQ(whole.value(), depth % 2 == 1) << trial;
    }
  }
}

TEST(DifferenceLevels, AreNoneOfAUnion) {
  EXPECT_TRUE(
      difference_levels(program_of(BooleanOp::kUnion, 3)).programs.empty());
}

}  // namespace
}  // namespace lamina::plane
