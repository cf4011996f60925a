// Pictures of stacks show what openscad's pictures of the same camera show.

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/cli/lamina.h"
#include "tests/cli/png_picture.h"

namespace lamina::cli {
namespace {

using support::TemporaryFolder;

// Looks different from everywhere.
constexpr const char* kDesign = R"(
linear_extrude(4)
  polygon([[0, 0], [20, 0], [20, 5], [6, 5], [6, 9], [14, 9], [14, 14],
           [6, 14], [6, 24], [0, 24]]);
translate([2, 2, 4]) cube([3, 12, 9]);
translate([12, 1, 4]) cylinder(r1 = 4, r2 = 1, h = 6, $fn = 24);
)";

// Both programs' background in their scheme Cornfield.
constexpr std::array<int, 3> kBackground = {255, 255, 229};

// What `a` shows of the solid, `b` shows within a pixel.
std::size_t missing(const Picture& a, const Picture& b) {
  std::size_t count = 0;
  for (unsigned y = 1; y + 1 < a.height; ++y) {
    for (unsigned x = 1; x + 1 < a.width; ++x) {
      if (a.at(x, y) == kBackground) continue;
      bool is_near = false;
      for (unsigned i = 0; i < 9 && !is_near; ++i) {
        is_near = b.at(x + i % 3 - 1, y + i / 3 - 1) != kBackground;
      }
      count += is_near ? 0 : 1;
    }
  }
  return count;
}

std::size_t shown(const Picture& picture) {
  std::size_t count = 0;
  for (unsigned y = 0; y < picture.height; ++y) {
    for (unsigned x = 0; x < picture.width; ++x) {
      count += picture.at(x, y) == kBackground ? 0 : 1;
    }
  }
  return count;
}

class OpenScadPicture : public testing::TestWithParam<std::string> {};

TEST_P(OpenScadPicture, ShowsTheSame) {
  const TemporaryFolder folder;
  folder.write("a.scad", kDesign);
  std::vector<std::string> options;
  for (std::size_t begin = 0; begin < GetParam().size();) {
    const std::size_t end =
        std::min(GetParam().find(' ', begin), GetParam().size());
    options.push_back(GetParam().substr(begin, end - begin));
    begin = end + 1;
  }
  std::vector<std::string> openscad = {
      "xvfb-run", "-a", "openscad", "a.scad", "-o", "openscad.png", "--render"};
  openscad.insert(openscad.end(), options.begin(), options.end());
  const auto theirs = support::run_process(openscad, folder.path());
  ASSERT_EQ(theirs.status, 0) << theirs.errors;
  std::vector<std::string> view = {"view",       "a.scad",        "-o",
                                   "lamina.png", "--colorscheme", "Cornfield"};
  view.insert(view.end(), options.begin(), options.end());
  const auto ours = run(folder, view);
  ASSERT_EQ(ours.status, 0) << ours.errors;

  const Picture expected = read_png(folder.file("openscad.png"));
  const Picture picture = read_png(folder.file("lamina.png"));
  ASSERT_EQ(picture.width, expected.width);
  ASSERT_EQ(picture.height, expected.height);
  EXPECT_GT(shown(expected), 1000U);
  EXPECT_EQ(missing(expected, picture), 0U);
  EXPECT_EQ(missing(picture, expected), 0U);
}

INSTANTIATE_TEST_SUITE_P(
    Cameras, OpenScadPicture,
    testing::Values("--imgsize=512,512",
                    "--camera=8,10,4,60,15,40,110 --imgsize=500,400",
                    "--camera=8,10,4,150,0,200,90 --projection=o",
                    "--camera=40,-30,25,8,10,4", "--camera=8,10,90,8,10,4",
                    "--camera=8,10,-90,8,10,4",
                    "--camera=1,2,3,55,0,25,140 --viewall --imgsize=300,400",
                    "--camera=1,2,3,80,0,130,140 --viewall --autocenter",
                    "--projection=o --imgsize=400,300"));

}  // namespace
}  // namespace lamina::cli
