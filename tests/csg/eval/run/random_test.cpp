#include "csg/eval/run/random.h"

#include <random>

#include <gtest/gtest.h>

namespace lamina::csg {
namespace {

TEST(MersenneTwister, GivesTheNumbersOfTheStandardLibrary) {
  MersenneTwister mine;
  std::mt19937 theirs;
  for (const std::uint32_t seed : {5489u, 0u, 1u, 42u, 0xffffffffu}) {
    mine.seed(seed);
    theirs.seed(seed);
    for (int i = 0; i < 3000; ++i) ASSERT_EQ(mine(), theirs()) << seed << i;
  }
}

TEST(MersenneTwister, StartsAnewWhereverItIsSeeded) {
  MersenneTwister mine;
  for (const int drawn : {0, 1, 226, 227, 228, 396, 397, 623, 624, 625}) {
    for (int i = 0; i < drawn; ++i) mine();
    mine.seed(7);
    std::mt19937 theirs(7);
    for (int i = 0; i < 700; ++i) ASSERT_EQ(mine(), theirs()) << drawn;
  }
}

}  // namespace
}  // namespace lamina::csg
