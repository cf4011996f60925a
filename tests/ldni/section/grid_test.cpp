#include "ldni/section/grid.h"

#include <cmath>
#include <cstdint>
#include <random>

#include <gtest/gtest.h>

namespace lamina::ldni {
namespace {

TEST(LayerGrid, SectionsStandInTheMiddleOfLayersByMultiplication) {
  const LayerGrid grid = LayerGrid::uniform(-1, 2, 0.1);
  EXPECT_EQ(grid.layer_count(), 30U);
  EXPECT_EQ(grid.section_z(0), -1 + 0.5 * 0.1);
  EXPECT_EQ(grid.section_z(17), -1 + 17.5 * 0.1);
  EXPECT_EQ(grid.layer_bottom(17), -1 + 17 * 0.1);
  EXPECT_EQ(grid.layer_top(17), -1 + 18 * 0.1);
}

TEST(LayerGrid, ComparingWithTheThresholdAndCountingLayersAreOneDecision) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int round = 0; round < 200; ++round) {
    const double bottom = 1000 * (unit(random) - 0.5);
    const double thickness = std::pow(10, -3 * unit(random));
    const LayerGrid grid =
        LayerGrid::uniform(bottom, bottom + 40 * thickness, thickness);
    for (int probe = 0; probe < 200; ++probe) {
      const auto layer =
          static_cast<std::uint32_t>(random() % grid.layer_count());
      // At a threshold, a rounding away from it, and anywhere.
      double z = grid.threshold(layer);
      if (probe % 4 == 1) z = std::nextafter(z, 1e9);
      if (probe % 4 == 2) z = std::nextafter(z, -1e9);
      if (probe % 4 == 3) z = bottom + 45 * thickness * unit(random);
      const std::uint32_t below = grid.layers_below(z);
      for (std::uint32_t l = 0; l < grid.layer_count(); ++l) {
        ASSERT_EQ(below > l, z > grid.threshold(l)) << bottom << ' ' << z;
      }
    }
  }
}

TEST(LayerGrid, StackedLayersReachFromBorderToBorder) {
  const LayerGrid grid = LayerGrid::stacked(-1, 0.1, {0, 1, 2, 5, 9});
  ASSERT_EQ(grid.layer_count(), 4U);
  EXPECT_EQ(grid.thickness(), 0);
  EXPECT_EQ(grid.layer_bottom(2), -1 + 2 * 0.1);
  EXPECT_EQ(grid.layer_top(2), -1 + 5 * 0.1);
  EXPECT_EQ(grid.section_z(2), -1 + 3.5 * 0.1);
  EXPECT_EQ(grid.layer_bottom(3), grid.layer_top(2));
  for (std::uint32_t l = 0; l < grid.layer_count(); ++l) {
    EXPECT_EQ(grid.layers_below(grid.section_z(l)), l);
    EXPECT_EQ(grid.layers_below(std::nextafter(grid.threshold(l), 1e9)), l + 1);
  }
}

TEST(LayerGrid, StackedLayersOfOneUnitAreUniformOnes) {
  const LayerGrid uniform = LayerGrid::uniform(-0.3, 1.7, 0.1);
  const LayerGrid stacked = LayerGrid::stacked(-0.3, 0.1, {0, 1, 2, 3, 4, 5});
  for (std::uint32_t l = 0; l < stacked.layer_count(); ++l) {
    EXPECT_EQ(stacked.section_z(l), uniform.section_z(l));
    EXPECT_EQ(stacked.layer_bottom(l), uniform.layer_bottom(l));
    EXPECT_EQ(stacked.layer_top(l), uniform.layer_top(l));
  }
}

TEST(LayerGrid, AVertexOnTheSectionCountsAsBelow) {
  const LayerGrid grid = LayerGrid::at_heights({-1, 0.5, 2});
  EXPECT_EQ(grid.layers_below(-1), 0U);
  EXPECT_EQ(grid.layers_below(-1 + 0.5e-9), 0U);
  EXPECT_EQ(grid.layers_below(-1 + 2e-9), 1U);
  EXPECT_EQ(grid.layers_below(2), 2U);
  EXPECT_EQ(grid.layers_below(7), 3U);
}

}  // namespace
}  // namespace lamina::ldni
