// What is decided with unknown leaves, judged by all values that they may have.

#include "plane/program/ternary_program.h"

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "plane/program/program_state.h"
#include "tests/plane/program/random_program.h"

namespace lamina::plane {
namespace {

// So few that all their values can be tried.
constexpr std::size_t kMostUnknown = 8;

std::vector<Ternary> random_values(std::size_t count, std::mt19937& random) {
  std::vector<Ternary> leaves;
  std::size_t unknown = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const bool may_be_unknown = unknown < kMostUnknown;
    const auto any = static_cast<Ternary>(random() % 3);
    const bool is_unknown = any == Ternary::kUnknown;
    unknown += is_unknown && may_be_unknown ? 1 : 0;
    leaves.push_back(is_unknown && !may_be_unknown ? Ternary::kTrue : any);
  }
  return leaves;
}

// The program's value for each set that the unknown ones may make up; the bits
// of its index say which of them are inside.
std::vector<bool> all_values(const BooleanProgram& program,
                             const std::vector<Ternary>& leaves) {
  std::vector<std::uint32_t> unknown;
  ProgramState surely(program);
  for (std::uint32_t i = 0; i < leaves.size(); ++i) {
    if (leaves[i] == Ternary::kUnknown) unknown.push_back(i);
    if (leaves[i] == Ternary::kTrue) surely.flip(i, true);
  }
  std::vector<bool> values;
  for (std::size_t set = 0; set < std::size_t{1} << unknown.size(); ++set) {
    ProgramState state = surely;
    for (std::size_t bit = 0; bit < unknown.size(); ++bit) {
      if ((set >> bit & 1) != 0) state.flip(unknown[bit], true);
    }
    values.push_back(state.value());
  }
  return values;
}

bool depends_on(std::size_t bit, const std::vector<bool>& values) {
  for (std::size_t set = 0; set < values.size(); ++set) {
    if (values[set] != values[set ^ std::size_t{1} << bit]) return true;
  }
  return false;
}

TEST(TernaryProgram, KnowsWhatNoUnknownLeafCanChange) {
  std::mt19937 random(11);
  for (int round = 0; round < 200; ++round) {
    const BooleanProgram program = random_program(random);
    TernaryProgram ternary(program, Ternary::kFalse);
    for (int step = 0; step < 5; ++step) {
      const auto leaves = random_values(program.operands.size(), random);
      for (std::uint32_t i = 0; i < leaves.size(); ++i) {
        ternary.set(i, leaves[i]);
      }
      const std::vector<bool> values = all_values(program, leaves);
      bool is_constant = true;
      std::size_t bit = 0;
      for (std::uint32_t i = 0; i < leaves.size(); ++i) {
        const bool matters =
            leaves[i] == Ternary::kUnknown && depends_on(bit++, values);
        is_constant = is_constant && !matters;
        ASSERT_EQ(ternary.matters(i), matters);
      }
      ASSERT_EQ(ternary.is_decided(), is_constant);
    }
  }
}

TEST(TernaryProgram, AnEmptyProgramIsDecided) {
  BooleanProgram program;
  program.nodes.push_back({BooleanOp::kIntersection, 0, false, 0});
  EXPECT_TRUE(TernaryProgram(program, Ternary::kUnknown).is_decided());
}

}  // namespace
}  // namespace lamina::plane
