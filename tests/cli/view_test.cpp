#include <vector>

#include <gtest/gtest.h>
#include <png.h>

#include "tests/cli/lamina.h"

namespace lamina::cli {
namespace {

using support::TemporaryFolder;

struct Picture {
  unsigned width = 0;
  unsigned height = 0;
  std::vector<unsigned char> rgb;
};

// As libpng's simple reader sees the file.
Picture read_png(const std::string& path) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  Picture picture;
  if (png_image_begin_read_from_file(&image, path.c_str()) == 0) return {};
  image.format = PNG_FORMAT_RGB;
  picture.rgb.resize(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, picture.rgb.data(), 0, nullptr) ==
      0) {
    return {};
  }
  picture.width = image.width;
  picture.height = image.height;
  return picture;
}

// Pixels of gold: much more red than blue.
double golden_share(const Picture& picture) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
    if (picture.rgb[i] > picture.rgb[i + 2] + 60) ++count;
  }
  return 3.0 * static_cast<double>(count) /
         static_cast<double>(picture.rgb.size());
}

TEST(View, DrawsASheetAndAStackOfAFile) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cylinder(r = 5, h = 3, $fn = 60);");
  ASSERT_EQ(run(folder, {"a.scad"}).status, 0);
  for (const char* const style : {"sheet", "stack"}) {
    const auto result = run(folder, {"view", "a.slc", "-o", "a.png", "--style",
                                     style, "--width", "400"});
    ASSERT_EQ(result.status, 0) << result.errors;
    const Picture picture = read_png(folder.file("a.png"));
    EXPECT_EQ(picture.width, 400U);
    EXPECT_GT(golden_share(picture), 0.15) << style;
    EXPECT_LT(golden_share(picture), 0.8) << style;
  }
}

TEST(View, AFileWithoutContoursIsAnError) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(1);");
  ASSERT_EQ(run(folder, {"a.scad", "--heights", "5,6"}).status, 0);
  const auto result = run(folder, {"view", "a.slc", "-o", "a.png"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.errors.find("no contour to draw"), std::string::npos);
  EXPECT_EQ(folder.entry_count(), 2U);
}

TEST(View, DrawsADesignDirectly) {
  const TemporaryFolder folder;
  folder.write("a.scad", "w = 1; cube([5, 3, w]);");
  const auto result = run(folder, {"view", "a.scad", "-o", "a.png", "-D", "w=3",
                                   "--layer", "0.25", "--width", "400"});
  ASSERT_EQ(result.status, 0) << result.errors;
  EXPECT_GT(golden_share(read_png(folder.file("a.png"))), 0.1);
  EXPECT_EQ(folder.entry_count(), 2U);
}

}  // namespace
}  // namespace lamina::cli
