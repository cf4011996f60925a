// What is told of a program with unknown leaves, judged by all that they may
// be.

#include "csg/boundary/program_range.h"

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "csg/program_state.h"
#include "tests/csg/random_program.h"

namespace lamina::csg {
namespace {

// So few that all their values can be tried.
constexpr std::size_t kMostUnknown = 8;

std::vector<Knowledge> random_knowledge(std::size_t count,
                                        std::mt19937& random) {
  std::vector<Knowledge> knowledge;
  std::size_t unknown = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const bool may_be_unknown = unknown < kMostUnknown;
    const auto any = static_cast<Knowledge>(random() % 3);
    const bool is_unknown = any == Knowledge::kUnknown;
    unknown += is_unknown && may_be_unknown ? 1 : 0;
    knowledge.push_back(is_unknown && !may_be_unknown ? Knowledge::kInside
                                                      : any);
  }
  return knowledge;
}

// The program's value for each set that the unknown ones may make up; the bits
// of its index say which of them are inside.
std::vector<bool> all_values(const Scene& scene,
                             const std::vector<Knowledge>& knowledge) {
  std::vector<std::uint32_t> unknown;
  ProgramState known(scene);
  for (std::uint32_t i = 0; i < knowledge.size(); ++i) {
    if (knowledge[i] == Knowledge::kUnknown) unknown.push_back(i);
    if (knowledge[i] == Knowledge::kInside) known.flip(i, true);
  }
  std::vector<bool> values;
  for (std::size_t set = 0; set < std::size_t{1} << unknown.size(); ++set) {
    ProgramState state = known;
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

TEST(ProgramRange, TellsWhatNoUnknownLeafCanChange) {
  std::mt19937 random(11);
  for (int round = 0; round < 200; ++round) {
    const Scene scene = random_program(random);
    ProgramRange range(scene);
    for (int step = 0; step < 5; ++step) {
      const auto knowledge = random_knowledge(scene.instances.size(), random);
      for (std::uint32_t i = 0; i < knowledge.size(); ++i) {
        range.set(i, knowledge[i]);
      }
      const std::vector<bool> values = all_values(scene, knowledge);
      bool is_constant = true;
      std::size_t bit = 0;
      for (std::uint32_t i = 0; i < knowledge.size(); ++i) {
        const bool matters =
            knowledge[i] == Knowledge::kUnknown && depends_on(bit++, values);
        is_constant = is_constant && !matters;
        ASSERT_EQ(range.matters(i), matters);
      }
      ASSERT_EQ(range.is_decided(), is_constant);
    }
  }
}

TEST(ProgramRange, AnEmptyProgramIsDecided) {
  Scene scene;
  scene.program.push_back({BooleanOp::kIntersection, 0, false, 0});
  EXPECT_TRUE(ProgramRange(scene).is_decided());
}

}  // namespace
}  // namespace lamina::csg
