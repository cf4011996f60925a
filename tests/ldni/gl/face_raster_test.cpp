#include "ldni/gl/face_raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "base/diagnostic.h"
#include "tests/ldni/gl/shared_raster.h"

namespace lamina::ldni {
namespace {

// A triangle in whole steps of 1/256 pixel, its corners on no pixel's middle.
using Corner = std::array<std::int64_t, 2>;
using Triangle = std::array<Corner, 3>;

// Twice the area of a, b, c: more than 0 where they run counter-clockwise.
std::int64_t twice_area(const Corner& a, const Corner& b, const Corner& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
}

enum class Cover { kOutside, kEdge, kEntry, kExit };

// What a pixel's middle sees of the triangle, in integers.
Cover cover(const Triangle& triangle, std::int64_t column, std::int64_t row) {
  const Corner middle = {256 * column + 128, 256 * row + 128};
  const bool is_entry = twice_area(triangle[0], triangle[1], triangle[2]) > 0;
  bool is_edge = false;
  for (int i = 0; i < 3; ++i) {
    std::int64_t side = twice_area(triangle[i], triangle[(i + 1) % 3], middle);
    if (!is_entry) side = -side;
    if (side < 0) return Cover::kOutside;
    is_edge = is_edge || side == 0;
  }
  if (is_edge) return Cover::kEdge;
  return is_entry ? Cover::kEntry : Cover::kExit;
}

std::vector<RasterCorner> raster_corners(const Triangle& triangle) {
  std::vector<RasterCorner> corners;
  for (const Corner& corner : triangle) {
    corners.push_back({static_cast<float>(corner[0]) / 256,
                       static_cast<float>(corner[1]) / 256, 0.5F});
  }
  return corners;
}

// Corners anywhere in the viewport, many on its border, many in the picture.
Corner random_corner(std::mt19937& random, int size) {
  Corner corner{};
  for (std::int64_t& coordinate : corner) {
    const int low = random() % 2 == 0 ? 0 : -kPictureMargin;
    std::uniform_int_distribution<std::int64_t> steps(256 * low,
                                                      256 * (size - low));
    coordinate =
        random() % 4 == 0 ? 256 * (kPictureMargin + size) : steps(random);
    if ((coordinate & 255) == 128) ++coordinate;
  }
  return corner;
}

TEST(FaceRaster, IsExactOnItsGrid) {
  std::mt19937 random(11);
  const auto raster = shared_raster();
  for (int round = 0; round < 600; ++round) {
    const int size = std::array{20, 60, 100, 300}[random() % 4];
    const Triangle triangle = {random_corner(random, size),
                               random_corner(random, size),
                               random_corner(random, size)};
    std::vector<Fragment> fragments;
    ASSERT_TRUE(raster->draw(raster_corners(triangle), size, size, fragments));
    std::vector<Cover> found(static_cast<std::size_t>(size) * size,
                             Cover::kOutside);
    for (const Fragment& fragment : fragments) {
      ASSERT_EQ(found[fragment.pixel], Cover::kOutside);
      found[fragment.pixel] =
          fragment.is_entry() ? Cover::kEntry : Cover::kExit;
    }
    std::size_t wrong = 0;
    for (std::size_t pixel = 0; pixel < found.size(); ++pixel) {
      const Cover expected = cover(triangle, pixel % size, pixel / size);
      if (expected == Cover::kEdge) continue;
      wrong += found[pixel] != expected;
    }
    ASSERT_EQ(wrong, 0U) << "round " << round << " size " << size;
  }
}

std::vector<std::uint64_t> sorted_fragments(const GlPlatform& platform) {
  const std::vector<RasterCorner> corners = {
      {-900, -50, 0.3F},     {1000, 20.5F, 0.3F},  {10.25F, 900, 0.7F},
      {5, 5, 0.5F},          {80, 90, 0.4F},       {70.75F, 2, 0.6F},
      {-1000, 50.25F, 0.5F}, {1000, 50.75F, 0.5F}, {1000, 60, 0.5F}};
  std::vector<Fragment> fragments;
  EXPECT_TRUE(make_face_raster(platform)->draw(corners, 100, 80, fragments));
  std::vector<std::uint64_t> result;
  for (const Fragment& fragment : fragments) {
    result.push_back(std::uint64_t{fragment.pixel} << 32 |
                     fragment.face_and_side);
  }
  std::sort(result.begin(), result.end());
  return result;
}

TEST(GlPlatform, OsMesaAndEglDrawTheSame) {
  const auto osmesa = open_osmesa();
  const auto egl = open_egl(EglDevice::kAny);
  const auto expected = sorted_fragments(*osmesa);
  EXPECT_GT(expected.size(), 5000U);
  EXPECT_EQ(sorted_fragments(*egl), expected);
}

TEST(GlPlatform, DrawsInSeveralThreadsAtOnce) {
  const auto platform = open_gl();
  const auto expected = sorted_fragments(*platform);
  std::vector<std::vector<std::uint64_t>> found(4);
  std::vector<std::thread> threads;
  for (auto& fragments : found) {
    threads.emplace_back([&] { fragments = sorted_fragments(*platform); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& fragments : found) EXPECT_EQ(fragments, expected);
}

TEST(GlPlatform, SaysWhatDraws) {
  const auto context = open_osmesa()->make_context();
  EXPECT_NE(renderer_name(*context).find("llvmpipe"), std::string::npos);
}

}  // namespace
}  // namespace lamina::ldni
