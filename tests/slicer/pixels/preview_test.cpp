#include "slicer/pixels/preview.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/contour_checks.h"

namespace lamina::slicer {
namespace {

constexpr unsigned kWidth = 480;
constexpr unsigned kHeight = 400;

// A ball of radius 5 in 200 layers.
std::vector<std::uint8_t> picture_of_ball(Vec3 middle) {
  constexpr double kRadius = 5;
  Preview preview({middle - Vec3(kRadius), middle + Vec3(kRadius)});
  for (int i = 0; i < 200; ++i) {
    Layer layer;
    const double z = -kRadius + 0.05 * i;
    layer.bottom = middle.z + z;
    layer.section_z = layer.bottom + 0.025;
    layer.top = layer.bottom + 0.05;
    const double radius = std::sqrt(kRadius * kRadius - std::pow(z + 0.025, 2));
    std::vector<Vec2> circle;
    for (int k = 0; k < 90; ++k) {
      const double angle = 2 * std::numbers::pi * k / 90;
      circle.push_back(Vec2(middle) +
                       radius * Vec2(std::cos(angle), std::sin(angle)));
    }
    support::add_loop(layer.contours, circle);
    preview.take(layer);
  }
  return preview.draw(kWidth, kHeight);
}

// The box of the pixels that are not as the one in the corner, and how many
// they are.
struct Seen {
  int left = kWidth;
  int right = 0;
  int top = kHeight;
  int bottom = 0;
  double count = 0;
};

Seen look_at(const std::vector<std::uint8_t>& pixels) {
  Seen seen;
  for (std::size_t i = 0; i < pixels.size(); i += 3) {
    if (std::equal(pixels.begin(), pixels.begin() + 3,
                   pixels.begin() + static_cast<std::ptrdiff_t>(i))) {
      continue;
    }
    const int x = static_cast<int>(i / 3 % kWidth);
    const int y = static_cast<int>(i / 3 / kWidth);
    seen.left = std::min(seen.left, x);
    seen.right = std::max(seen.right, x + 1);
    seen.top = std::min(seen.top, y);
    seen.bottom = std::max(seen.bottom, y + 1);
    ++seen.count;
  }
  return seen;
}

TEST(Preview, ABallIsARoundDiskInTheMiddle) {
  const auto pixels = picture_of_ball({0, 0, 5});
  ASSERT_EQ(pixels.size(), 3U * kWidth * kHeight);
  const Seen seen = look_at(pixels);
  const double width = seen.right - seen.left;
  const double height = seen.bottom - seen.top;
  EXPECT_NEAR(width, height, 4);
  EXPECT_NEAR(seen.count / (width * height), std::numbers::pi / 4, 0.02);
  EXPECT_NEAR(seen.left + seen.right, kWidth, 4);
  EXPECT_NEAR(seen.top + seen.bottom, kHeight, 4);
}

TEST(Preview, TheKeyLightComesFromTheUpperLeft) {
  const auto pixels = picture_of_ball({0, 0, 5});
  const auto green_at = [&](std::size_t x, std::size_t y) {
    return pixels[3 * (y * kWidth + x) + 1];
  };
  EXPECT_GT(green_at(200, 150), green_at(280, 250) + 40);
}

TEST(Preview, WhereThePartStandsDoesNotMatter) {
  const Seen here = look_at(picture_of_ball({0, 0, 5}));
  const Seen there = look_at(picture_of_ball({300, -70, 20}));
  EXPECT_NEAR(here.count, there.count, here.count / 100);
  EXPECT_NEAR(here.left, there.left, 2);
  EXPECT_NEAR(here.top, there.top, 2);
}

TEST(Preview, NothingIsAnEmptyPicture) {
  EXPECT_EQ(look_at(Preview(Box3{}).draw(kWidth, kHeight)).count, 0);
}

}  // namespace
}  // namespace lamina::slicer
