#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <png.h>

#include "base/file/format_error.h"
#include "csg/import/surface_file.h"
#include "csg/limits.h"
#include "tests/csg/import/byte_changes.h"

namespace lamina::csg {
namespace {

// The bytes of a PNG image. `format` as libpng names it.
std::string make_png(std::uint32_t columns, std::uint32_t rows,
                     std::uint32_t format,
                     const std::vector<std::uint8_t>& pixels) {
  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  image.width = columns;
  image.height = rows;
  image.format = format;
  png_alloc_size_t size = 0;
  png_image_write_to_memory(&image, nullptr, &size, 0, pixels.data(), 0,
                            nullptr);
  std::string bytes(size, '\0');
  png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0,
                            nullptr);
  return bytes;
}

double volume(const Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]];
    const Vec3 b = mesh.vertices[t[1]];
    const Vec3 c = mesh.vertices[t[2]];
    sum += a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
           a.z * (b.x * c.y - b.y * c.x);
  }
  return sum / 6;
}

bool is_closed(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(t[i], t[(i + 1) % 3]);
      balance[{low, high}] += t[i] == low ? 1 : -1;
    }
  }
  for (const auto& [edge, sum] : balance) {
    if (sum != 0) return false;
  }
  return true;
}

void expect_too_many(const std::function<void()>& parse,
                     const std::string& size) {
  try {
    parse();
    FAIL() << "parsed";
  } catch (const plane::LimitExceeded& limit) {
    EXPECT_EQ(limit.what(), "Too many heights: " + size +
                                " of a surface, at most 8388608 can be");
  }
}

TEST(ParseDat, ReadsRowsAndComments) {
  const HeightField field = parse_dat("# a hill\n1 2 3\n\n4\t5 6\r\n#end\n");
  EXPECT_EQ(field.columns, 3U);
  EXPECT_EQ(field.rows, 2U);
  EXPECT_EQ(field.heights, (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(field.bottom, 0);
  EXPECT_EQ(field.fault, "");
}

TEST(ParseDat, TheBottomIsOneBelowTheLeast) {
  EXPECT_EQ(parse_dat("0.5 2\n-3 4\n").bottom, -4);
}

TEST(ParseDat, ShortRowsEndInZero) {
  EXPECT_EQ(parse_dat("1\n2 3\n").heights, (std::vector<double>{1, 0, 2, 3}));
}

TEST(ParseDat, AWordThatIsNoNumberEndsIt) {
  const HeightField field = parse_dat("1 2\n3 x\n5 6\n");
  EXPECT_EQ(field.heights, (std::vector<double>{1, 2, 3, 0}));
  EXPECT_NE(field.fault, "");
}

// Filled up to the length of the longest one, these rows would take 7 GB.
TEST(ParseDat, OneLongRowDoesNotMakeAllLong) {
  std::string text;
  for (int i = 0; i < 30000; ++i) text += "0 ";
  for (int i = 0; i < 30000; ++i) text += "\n0";
  expect_too_many([&] { parse_dat(text); }, "30000 x 280");
}

TEST(ParsePng, HeightsAreLuminancesFromTheLowestRowUp) {
  const HeightField field =
      parse_png(make_png(2, 2, PNG_FORMAT_RGB,
                         {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}),
                false);
  ASSERT_EQ(field.heights.size(), 4U);
  EXPECT_NEAR(field.heights[0], 7.22, 1e-9);
  EXPECT_NEAR(field.heights[1], 100, 1e-9);
  EXPECT_NEAR(field.heights[2], 21.26, 1e-9);
  EXPECT_NEAR(field.heights[3], 71.52, 1e-9);
}

TEST(ParsePng, ReadsGreyAndInverts) {
  const auto bytes = make_png(2, 1, PNG_FORMAT_GRAY, {0, 255});
  EXPECT_NEAR(parse_png(bytes, false).heights[1], 100, 1e-9);
  EXPECT_NEAR(parse_png(bytes, true).heights[0], 100.0 / 255, 1e-9);
  EXPECT_NEAR(parse_png(bytes, true).heights[1], -25400.0 / 255, 1e-9);
}

TEST(ParsePng, RefusesHugeImages) {
  std::string bytes = make_png(2, 1, PNG_FORMAT_GRAY, {0, 255});
  // Width and height stand behind the mark and the header's length and name;
  // their check sum is wrong then, and said to be so.
  bytes[16] = bytes[20] = 0x10;
  EXPECT_NE(fault_of([&] { parse_png(bytes, false); }), "");
  const std::string large =
      make_png(4000, 3000, PNG_FORMAT_GRAY,
               std::vector<std::uint8_t>(std::size_t{4000} * 3000));
  expect_too_many([&] { parse_png(large, false); }, "4000 x 3000");
}

TEST(ParsePng, SurvivesWhateverBefallsAFile) {
  expect_no_harm(make_png(3, 2, PNG_FORMAT_GRAY, {1, 2, 3, 4, 5, 6}),
                 [](std::string_view bytes) { parse_png(bytes, false); });
}

TEST(MakeSurface, IsClosedAndHoldsTheMeanHeights) {
  const HeightField field = parse_dat("1 2 3\n4 5 6\n7 8 -1\n");
  const Mesh mesh = make_surface(field, false);
  EXPECT_TRUE(is_closed(mesh));
  // Over each cell the mean of its corners, above the bottom at -2.
  EXPECT_NEAR(volume(mesh), (12.0 + 16 + 24 + 18) / 4 + 4 * 2, 1e-12);
}

TEST(MakeSurface, IsCentredInXAndY) {
  const Mesh mesh = make_surface(parse_dat("1 2 3\n4 5 6\n"), true);
  EXPECT_EQ(mesh.vertices.front(), Vec3(-1, -0.5, 1));
}

TEST(MakeSurface, NeedsTwoRowsAndColumns) {
  EXPECT_TRUE(make_surface(parse_dat("1 2 3\n"), false).triangles.empty());
  EXPECT_TRUE(make_surface(parse_dat("1\n2\n"), false).triangles.empty());
  EXPECT_TRUE(make_surface(parse_dat(""), false).triangles.empty());
}

}  // namespace
}  // namespace lamina::csg
