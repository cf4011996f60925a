#include "slicer/plan/detail/stacking.h"

#include <algorithm>
#include <limits>
#include <map>
#include <random>

#include <gtest/gtest.h>

namespace lamina::slicer {
namespace {

using Borders = std::vector<std::uint32_t>;

bool is_allowed(const Plies& plies, std::uint16_t greatest,
                std::uint32_t bottom, std::uint32_t top) {
  if (top - bottom > greatest) return false;
  for (std::uint32_t i = bottom; i < top; ++i) {
    if (top - bottom > plies.limits[i]) return false;
    if (i > bottom && plies.must_part[i]) return false;
  }
  return true;
}

std::size_t count_runs(const Borders& borders) {
  std::size_t runs = 0;
  std::uint32_t last = 0;
  for (std::size_t i = 1; i < borders.size(); ++i) {
    const std::uint32_t size = borders[i] - borders[i - 1];
    if (size != last) ++runs;
    last = size;
  }
  return runs;
}

// The fewest layers for each number of runs, by trying everything.
void try_all(const Plies& plies, std::uint16_t greatest, Borders& borders,
             std::map<std::size_t, std::size_t>& fewest) {
  if (borders.back() == plies.limits.size()) {
    const std::size_t runs = count_runs(borders);
    const auto [it, is_new] = fewest.emplace(runs, borders.size() - 1);
    if (!is_new) it->second = std::min(it->second, borders.size() - 1);
    return;
  }
  for (std::uint32_t size = 1; size <= greatest; ++size) {
    const std::uint32_t top = borders.back() + size;
    if (top > plies.limits.size()) break;
    if (!is_allowed(plies, greatest, borders.back(), top)) continue;
    borders.push_back(top);
    try_all(plies, greatest, borders, fewest);
    borders.pop_back();
  }
}

Plies random_plies(std::mt19937_64& random, std::size_t count,
                   std::uint16_t greatest) {
  Plies plies;
  for (std::size_t i = 0; i < count; ++i) {
    plies.limits.push_back(
        static_cast<std::uint16_t>(1 + random() % (greatest + 1U)));
  }
  for (std::size_t i = 0; i <= count; ++i) {
    plies.must_part.push_back(random() % 5 == 0);
  }
  return plies;
}

TEST(StackLayers, GivesTheFewestLayersThatAreAllowed) {
  std::mt19937_64 random(7);
  for (int round = 0; round < 300; ++round) {
    const auto greatest = static_cast<std::uint16_t>(1 + random() % 4);
    const Plies plies = random_plies(random, 1 + random() % 12, greatest);
    Borders start = {0};
    std::map<std::size_t, std::size_t> fewest;
    try_all(plies, greatest, start, fewest);
    std::size_t least = 1000;
    for (const auto& [runs, layers] : fewest) least = std::min(least, layers);

    const Borders borders = stack_layers(plies, greatest, 255);
    ASSERT_EQ(borders.front(), 0U);
    ASSERT_EQ(borders.back(), plies.limits.size());
    EXPECT_EQ(borders.size() - 1, least);
    for (std::size_t i = 1; i < borders.size(); ++i) {
      ASSERT_TRUE(is_allowed(plies, greatest, borders[i - 1], borders[i]));
    }
  }
}

TEST(StackLayers, KeepsToTheRunsThatATableHas) {
  std::mt19937_64 random(8);
  for (int round = 0; round < 200; ++round) {
    const Plies plies = random_plies(random, 12, 4);
    Borders start = {0};
    std::map<std::size_t, std::size_t> fewest;
    try_all(plies, 4, start, fewest);
    for (std::size_t most = 1; most < 6; ++most) {
      const Borders borders = stack_layers(plies, 4, most);
      const std::size_t runs = count_runs(borders);
      ASSERT_LE(runs, most);
      ASSERT_EQ(borders.back(), 12U);
      for (std::size_t i = 1; i < borders.size(); ++i) {
        ASSERT_TRUE(is_allowed(plies, 4, borders[i - 1], borders[i]));
      }
      // No stack of as many runs has fewer layers.
      EXPECT_EQ(borders.size() - 1, fewest.at(runs));
    }
  }
}

TEST(StackLayers, ThinnestLayersAloneAreTheLastResort) {
  Plies plies;
  for (int i = 0; i < 99; ++i) plies.limits.push_back(i % 3 == 0 ? 1 : 2);
  plies.must_part.assign(100, false);
  EXPECT_EQ(stack_layers(plies, 2, 255).size(), 1 + 66U);
  EXPECT_EQ(stack_layers(plies, 2, 1).size(), 1 + 99U);
}

// All that a layer can have, and more than there are.
TEST(StackLayers, TakesAllPliesIntoALayerThatMayHaveThem) {
  constexpr std::uint16_t kMost = std::numeric_limits<std::uint16_t>::max();
  Plies plies;
  plies.limits.assign(5, kMost);
  plies.must_part.assign(6, false);
  EXPECT_EQ(stack_layers(plies, kMost, 255), (Borders{0, 5}));
  plies.must_part[2] = true;
  EXPECT_EQ(stack_layers(plies, kMost, 255), (Borders{0, 2, 5}));
}

TEST(StackLayers, NoPliesAreNoLayers) {
  Plies plies;
  plies.must_part.assign(1, true);
  EXPECT_EQ(stack_layers(plies, 4, 255), Borders{0});
}

}  // namespace
}  // namespace lamina::slicer
