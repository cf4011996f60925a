#include "ldni/section/detail/csg_pruning.h"

#include <algorithm>
#include <cstdint>

#include <gtest/gtest.h>

#include "tests/ldni/support/scene_builder.h"

namespace lamina::ldni::detail {
namespace {

using namespace lamina::testing;
using plane::BooleanOp;

constexpr std::uint64_t kMostQuestions = 64;

TEST(CsgPruning, LeavesOutWhatASubtrahendDoesNotReach) {
  SceneBuilder builder(BooleanOp::kDifference);
  builder.add(cube_leaf({1, 1, 1}));
  builder.add(cube_leaf({1, 1, 1}), translated({0.5, 0, 0}));
  builder.add(cube_leaf({1, 1, 1}), translated({5, 0, 0}));
  const csg::Scene scene = builder.finish();
  CsgPruning pruning(scene);
  EXPECT_TRUE(pruning.matters(0));
  EXPECT_TRUE(pruning.matters(1));
  EXPECT_FALSE(pruning.matters(2));
}

// However deep the operators are nested, an answer asks few of them.
void expect_few_questions(const csg::Scene& scene) {
  CsgPruning pruning(scene);
  std::uint64_t most = 0;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const std::uint64_t before = pruning.questions();
    pruning.matters(i);
    most = std::max(most, pruning.questions() - before);
  }
  EXPECT_LE(most, kMostQuestions);
}

// Within each difference the next one is listed before its own leaf.
TEST(CsgPruning, AsksFewOfNestedDifferences) {
  SceneBuilder builder(BooleanOp::kDifference);
  for (int i = 0; i < 2000; ++i) {
    builder.add(cube_leaf({1, 1, 1}));
    builder.begin(BooleanOp::kDifference);
  }
  builder.add(cube_leaf({1, 1, 1}));
  for (int i = 0; i < 2000; ++i) builder.end();
  expect_few_questions(builder.finish());
}

// Operators with many children are climbed without a look at these.
TEST(CsgPruning, ClimbsFewOfNestedUnions) {
  SceneBuilder builder;
  for (int i = 0; i < 200; ++i) {
    for (int k = 0; k < 40; ++k) builder.add(cube_leaf({1, 1, 1}));
    builder.begin(BooleanOp::kUnion);
  }
  builder.add(cube_leaf({1, 1, 1}));
  for (int i = 0; i < 200; ++i) builder.end();
  expect_few_questions(builder.finish());
}

}  // namespace
}  // namespace lamina::ldni::detail
