#include "ldni/image/ray_grid.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace lamina::ldni {
namespace {

TEST(RayGrid, HoldsExactlyTheRaysInItsBounds) {
  for (const double pitch : {0.0127, 0.05, 0.3, 1.0, 7.0}) {
    const RayGrid rays(-3, 11.5, pitch);
    ASSERT_GT(rays.ray_count(), 0U);
    EXPECT_GT(rays.ray_x(0), -3);
    EXPECT_LT(rays.ray_x(0) - pitch, -3);
    EXPECT_LT(rays.ray_x(rays.ray_count() - 1), 11.5);
    EXPECT_GE(rays.ray_x(rays.ray_count()), 11.5);
  }
}

TEST(RayGrid, MayHoldNoRayWhereTheSceneIsNarrowerThanThePitch) {
  EXPECT_EQ(RayGrid(0, 0.5, 1.0).ray_count(), 0U);
  EXPECT_EQ(RayGrid(0, 0.7, 1.0).ray_count(), 1U);
}

TEST(RayGrid, CountsTheRaysLeftOfAPlace) {
  const RayGrid rays(-3, 11.5, 0.05);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-5, 13);
  for (int i = 0; i < 10000; ++i) {
    const double x = place(random);
    std::uint32_t expected = 0;
    if (x > rays.ray_x(0)) {
      expected = static_cast<std::uint32_t>((x - rays.ray_x(0)) / 0.05) + 1;
    }
    expected = std::min(expected, rays.ray_count());
    ASSERT_EQ(rays.rays_below(x), expected) << x;
  }
}

TEST(RayGrid, KeepsItsRaysOffRoundCoordinates) {
  // A thousandth of the pitch is enough to be off; the bounds of designs and
  // their walls are multiples of the pitch or of simple fractions of it.
  const RayGrid rays(-10, 10, 0.05);
  for (std::uint32_t ray = 0; ray < rays.ray_count(); ++ray) {
    const double in_eighths = rays.ray_x(ray) / (0.05 / 8);
    EXPECT_GT(std::abs(in_eighths - std::round(in_eighths)), 0.008);
  }
}

TEST(GridBox, LocalBoxMapsToTheGlobalRaysAndLayersOfTheLeaf) {
  const RayGrid rays(0, 10, 1);  // at 0.618, 1.618, …
  const LayerGrid layers = LayerGrid::uniform(0, 4, 0.5);  // at 0.25, 0.75, …
  const GridBox box = local_box({Vec3(2, -1, 1), Vec3(5, 1, 2)}, rays, layers);
  EXPECT_EQ(box.ray_start, 2U);
  EXPECT_EQ(box.ray_count, 3U);  // 2.618, 3.618, 4.618
  EXPECT_EQ(box.layer_start, 2U);
  EXPECT_EQ(box.layer_count, 2U);  // 1.25, 1.75
  EXPECT_EQ(box.pixel_count(), 6U);
}

TEST(GridBox, LocalBoxStaysInTheGlobalOne) {
  const RayGrid rays(0, 10, 1);
  const LayerGrid layers = LayerGrid::uniform(0, 4, 0.5);
  const GridBox all = global_box(rays, layers);
  const GridBox box = local_box({Vec3(-50), Vec3(50)}, rays, layers);
  EXPECT_EQ(box.ray_start, 0U);
  EXPECT_EQ(box.ray_count, all.ray_count);
  EXPECT_EQ(box.layer_count, all.layer_count);
  EXPECT_TRUE(local_box({Vec3(11), Vec3(12)}, rays, layers).is_empty());
  EXPECT_TRUE(local_box(Box3(), rays, layers).is_empty());
}

TEST(GridBox, ClipsToTheLayersOfABlock) {
  const GridBox box{3, 4, 10, 20};
  const GridBox middle = clip_to_layers(box, 16, 8);
  EXPECT_EQ(middle.layer_start, 16U);
  EXPECT_EQ(middle.layer_count, 8U);
  EXPECT_EQ(middle.ray_start, 3U);
  EXPECT_EQ(clip_to_layers(box, 0, 16).layer_count, 6U);
  EXPECT_EQ(clip_to_layers(box, 24, 100).layer_count, 6U);
  EXPECT_TRUE(clip_to_layers(box, 0, 10).is_empty());
  EXPECT_TRUE(clip_to_layers(box, 30, 10).is_empty());
}

}  // namespace
}  // namespace lamina::ldni
