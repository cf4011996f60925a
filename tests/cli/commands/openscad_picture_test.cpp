// Pictures of stacks show what openscad's pictures of the same camera show.

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/cli/lamina.h"
#include "tests/cli/png_picture.h"

namespace lamina::cli {
namespace {

using support::TemporaryFolder;

// Looks different from everywhere.
constexpr const char* kLopsidedDesign = R"(
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
  folder.write("a.scad", kLopsidedDesign);
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

// Pure colors, which light does not mix, and the scheme's own, which is none of
// them.
constexpr const char* kColored = R"(
$fn = 48;
difference() {
  color("red") cube([20, 8, 6]);
  color("red") translate([5, -1, 3]) cube([4, 10, 4]);
}
color("lime") translate([14, 4, 6]) sphere(4);
color("blue") color("red") translate([0, 12, 0]) intersection() {
  cube(8);
  translate([4, 4, 4]) sphere(5);
}
color("blue") translate([12, 16, 0]) cylinder(r1 = 4, r2 = 0, h = 8);
translate([22, 0, 0]) cube([4, 20, 3]);
)";

constexpr int kWhite = 7;

// 1, 2, 4: red, green and blue, or the sum of those that there are.
int hue_of(std::array<int, 3> rgb) {
  const int brightest = std::max({rgb[0], rgb[1], rgb[2], 30});
  int hue = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    if (2 * rgb[c] > brightest) hue |= 1 << c;
  }
  return hue;
}

// Away from edges, where both programs mix what is beside each other.
TEST(OpenScadPicture, HasTheSameColors) {
  const TemporaryFolder folder;
  folder.write("a.scad", kColored);
  const std::vector<std::string> camera = {"--camera=10,10,0,50,0,30,110",
                                           "--imgsize=400,300"};
  std::vector<std::string> openscad = {"xvfb-run", "-a", "openscad",
                                       "a.scad",   "-o", "openscad.png"};
  openscad.insert(openscad.end(), camera.begin(), camera.end());
  const auto theirs = support::run_process(openscad, folder.path());
  ASSERT_EQ(theirs.status, 0) << theirs.errors;
  std::vector<std::string> words = {"a.scad", "-o", "lamina.png",
                                    "--colorscheme", "Cornfield"};
  words.insert(words.end(), camera.begin(), camera.end());
  const auto ours = run(folder, words);
  ASSERT_EQ(ours.status, 0) << ours.errors;
  const Picture expected = read_png(folder.file("openscad.png"));
  const Picture picture = read_png(folder.file("lamina.png"));
  ASSERT_EQ(picture.width, expected.width);
  std::map<int, int> counts;
  int mirrors = 0;  // pixels that show a lamp
  for (unsigned y = 2; y + 2 < picture.height; ++y) {
    for (unsigned x = 2; x + 2 < picture.width; ++x) {
      const int hue = hue_of(expected.at(x, y));
      bool is_inside = expected.at(x, y) != kBackground;
      for (unsigned i = 0; i < 25 && is_inside; ++i) {
        is_inside = hue_of(expected.at(x + i % 5 - 2, y + i / 5 - 2)) == hue;
      }
      if (!is_inside) continue;
      ++counts[hue];
      const int shown = hue_of(picture.at(x, y));
      if (shown == kWhite) {
        ++mirrors;
      } else {
        ASSERT_EQ(shown, hue) << x << ' ' << y;
      }
    }
  }
  for (const int hue : {1, 2, 3, 4}) EXPECT_GT(counts[hue], 500) << hue;
  EXPECT_LT(mirrors, 300);
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
