#include "slicer/pixels/png_encoder.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <png.h>

#include "plane/loop_area.h"
#include "tests/support/contour_checks.h"

namespace lamina::slicer {
namespace {

struct Picture {
  unsigned width = 0;
  unsigned height = 0;
  bool has_colour = false;
  std::vector<std::uint8_t> bytes;
};

Picture read_png(const std::string& file) {
  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&image, file.data(), file.size()),
            0);
  Picture picture = {image.width,
                     image.height,
                     (image.format & PNG_FORMAT_FLAG_COLOR) != 0,
                     {}};
  image.format = picture.has_colour ? PNG_FORMAT_RGB : PNG_FORMAT_GRAY;
  picture.bytes.resize(PNG_IMAGE_SIZE(image));
  EXPECT_NE(
      png_image_finish_read(&image, nullptr, picture.bytes.data(), 0, nullptr),
      0);
  EXPECT_EQ(image.warning_or_error, 0U) << image.message;
  return picture;
}

double sum_of(const Picture& picture) {
  double sum = 0;
  for (const std::uint8_t byte : picture.bytes) sum += byte;
  return sum / 255;
}

// A ring of many corners around (x, y).
plane::Contours ring(Vec2 middle, double radius) {
  constexpr int kCorners = 720;
  std::vector<Vec2> outer;
  std::vector<Vec2> inner;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * M_PI * i / kCorners;
    const Vec2 direction(std::cos(angle), std::sin(angle));
    outer.push_back(middle + radius * direction);
    inner.insert(inner.begin(), middle + radius / 2 * direction);
  }
  plane::Contours contours;
  support::add_loop(contours, outer);
  support::add_loop(contours, inner);
  return contours;
}

double area_of(const plane::Contours& contours) {
  return signed_area(contours.loop(0)) + signed_area(contours.loop(1));
}

TEST(DrawGreyPng, AnEmptyLayerIsBlack) {
  const Picture picture = read_png(draw_grey_png({}, 1440, 2560, {}));
  EXPECT_EQ(picture.width, 1440U);
  EXPECT_EQ(picture.height, 2560U);
  EXPECT_FALSE(picture.has_colour);
  EXPECT_EQ(sum_of(picture), 0);
}

// Pixels of 1 mm, y up, in a panel so large that it is drawn in bands.
TEST(DrawGreyPng, CoversTheAreaOfTheContours) {
  constexpr unsigned kWidth = 1800;
  constexpr unsigned kHeight = 1200;
  PixelMap map;
  map.origin = {0, kHeight};
  for (const Vec2 middle : {Vec2(900, 600), Vec2(560.3, 640.9)}) {
    const plane::Contours contours = ring(middle, 555.5);
    const Picture picture =
        read_png(draw_grey_png(contours, kWidth, kHeight, map));
    // Half a grey for each pixel on the edge.
    EXPECT_NEAR(sum_of(picture), area_of(contours), 2 * 8 * 556 * 0.5 / 255);
    // The hole is black, the ring white, above it there is nothing.
    const auto grey = [&](double x, double y) {
      return picture
          .bytes[(kHeight - 1 - static_cast<std::size_t>(y)) * kWidth +
                 static_cast<std::size_t>(x)];
    };
    EXPECT_EQ(grey(middle.x, middle.y), 0);
    EXPECT_EQ(grey(middle.x, middle.y + 400), 255);
    EXPECT_EQ(grey(middle.x + 400, middle.y), 255);
    EXPECT_EQ(grey(middle.x + 400, middle.y + 500), 0);
  }
}

TEST(DrawGreyPng, ThreePixelsAreTheColoursOfOne) {
  const plane::Contours contours = ring({15, 10}, 9.7);
  PixelMap map;
  map.origin = {0, 20};
  const Picture grey = read_png(draw_grey_png(contours, 30, 20, map));
  const Picture colour =
      read_png(draw_grey_png(contours, 30, 20, map, PixelLayout::kThreeInOne));
  EXPECT_EQ(colour.width, 10U);
  EXPECT_EQ(colour.height, 20U);
  EXPECT_TRUE(colour.has_colour);
  EXPECT_EQ(colour.bytes, grey.bytes);
}

}  // namespace
}  // namespace lamina::slicer
