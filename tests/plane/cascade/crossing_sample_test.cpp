#include "plane/cascade/crossing_sample.h"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace lamina::plane {
namespace {

constexpr std::uint32_t kChainCount = 1000;

// A chain from (0, i) over (1, middle) to (2, end(i)) for each i.
template <typename End>
double crossings_per_chain(double tie_distance, const End& end) {
  std::vector<Vec2> points;
  std::vector<Chain> chains;
  for (std::uint32_t i = 0; i < kChainCount; ++i) {
    chains.push_back({static_cast<std::uint32_t>(points.size()), 3, i, 1});
    points.push_back({0, i});
    points.push_back({1, 2.0 * kChainCount});
    points.push_back({2, end(i)});
  }
  return sample_crossings_per_chain({points, chains, {}}, tie_distance);
}

TEST(CrossingSample, OfChainsThatAllCrossIsHalfTheirNumber) {
  const auto end = [](std::uint32_t i) { return double{kChainCount} - i; };
  // All but a chain with itself, one pair in a thousand.
  EXPECT_NEAR(crossings_per_chain(1e-5, end), kChainCount / 2.0, 5);
}

TEST(CrossingSample, OfAShareOfThePairsIsThatShare) {
  // The first half of the chains crosses the second one: half of all pairs.
  const auto end = [](std::uint32_t i) {
    return i < kChainCount / 2 ? double{kChainCount} + i : 1.0 * i;
  };
  EXPECT_NEAR(crossings_per_chain(1e-5, end), kChainCount / 4.0,
              kChainCount / 40.0);
}

TEST(CrossingSample, OfChainsApartOrTiedIsNothing) {
  EXPECT_EQ(crossings_per_chain(1e-5, [](std::uint32_t i) { return 1.0 * i; }),
            0);
  const auto reversed = [](std::uint32_t i) { return double{kChainCount} - i; };
  EXPECT_EQ(crossings_per_chain(2 * kChainCount, reversed), 0);
}

TEST(CrossingSample, OfNoChainsIsNothing) {
  EXPECT_EQ(sample_crossings_per_chain({}, 1e-5), 0);
}

}  // namespace
}  // namespace lamina::plane
