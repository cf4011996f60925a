#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/cli/lamina.h"
#include "tests/cli/png_picture.h"

namespace lamina::cli {
namespace {

using support::TemporaryFolder;

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
  for (const char* const file :
       {"a.slc", "a.cli", "a.svg", "a.slices.3mf", "a.layers.json"}) {
    ASSERT_EQ(run(folder, {"a.scad", "-o", file}).status, 0);
    for (const bool is_stack : {false, true}) {
      std::vector<std::string> words = {"view", file, "-o", "a.png"};
      if (is_stack) {
        words.insert(words.end(), {"--imgsize", "400,300"});
      } else {
        words.insert(words.end(), {"--width", "400"});
      }
      const auto result = run(folder, words);
      ASSERT_EQ(result.status, 0) << result.errors;
      const Picture picture = read_png(folder.file("a.png"));
      EXPECT_EQ(picture.width, 400U);
      EXPECT_GT(golden_share(picture), 0.1) << file;
      EXPECT_LT(golden_share(picture), 0.8) << file;
    }
  }
}

// As openscad's -o x.png is.
TEST(View, DrawsWhatSlicingIsAskedToDraw) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cylinder(r = 5, h = 3, $fn = 60);");
  EXPECT_EQ(run(folder, {"a.scad", "-o", "a.png", "--imgsize=90,80"}).status,
            0);
  EXPECT_EQ(run(folder, {"view", "a.scad", "--style", "stack", "-o", "b.png",
                         "--imgsize=90,80"})
                .status,
            0);
  EXPECT_EQ(support::read_file(folder.file("a.png")),
            support::read_file(folder.file("b.png")));
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"-o", "c.png/"},
        {"-o", "d.png", "--printer", "plain"},
        {"-o", "e", "--export-format", "png"}}) {
    std::vector<std::string> all = {"a.scad", "--layer", "1"};
    all.insert(all.end(), words.begin(), words.end());
    EXPECT_EQ(run(folder, all).status, 0);
    EXPECT_FALSE(
        support::read_file(folder.file(words[1] + "/00002.png")).empty());
  }
}

// Pixels of the colour of supports.
bool is_blue(const std::array<int, 3>& pixel) {
  return pixel[2] > pixel[0] + 20;
}
bool is_golden(const std::array<int, 3>& pixel) {
  return pixel[0] > pixel[2] + 60;
}

template <typename IsMeant>
double count_pixels(const Picture& picture, const IsMeant& is_meant) {
  double count = 0;
  for (unsigned y = 0; y < picture.height; ++y) {
    for (unsigned x = 0; x < picture.width; ++x) {
      if (is_meant(picture.at(x, y))) ++count;
    }
  }
  return count;
}

// A cube of 6 mm in the air on a bar, of which 1 mm by 2 are beside the cube
// where it is in it.
constexpr const char* kCubeOnABar = R"(
module support_of() { translate([5, 2, 0]) cube([2, 2, 4.5]); }
translate([0, 0, 4]) cube(6);
support_of();
)";

TEST(View, ShowsSupportsOfALayerInTheirColor) {
  const TemporaryFolder folder;
  folder.write("a.scad", kCubeOnABar);
  const auto draw = [&](const char* file, const char* height) {
    const auto result = run(folder, {"view", file, "-o", "a.png", "--at",
                                     height, "--layer", "0.25"});
    EXPECT_EQ(result.status, 0) << result.errors;
    return read_png(folder.file("a.png"));
  };
  const Picture below = draw("a.scad", "2.1");
  EXPECT_GT(count_pixels(below, is_blue), 1e5);
  EXPECT_EQ(count_pixels(below, is_golden), 0);
  const Picture both = draw("a.scad", "4.3");
  EXPECT_NEAR(count_pixels(both, is_blue) / count_pixels(both, is_golden),
              2.0 / 36, 0.04 * 2 / 36);
  const Picture above = draw("a.scad", "5.1");
  EXPECT_EQ(count_pixels(above, is_blue), 0);
  EXPECT_GT(count_pixels(above, is_golden), 1e5);
}

TEST(View, ShowsSupportsOfAStackInTheirColor) {
  const TemporaryFolder folder;
  folder.write("a.scad", kCubeOnABar);
  // From the left: of the bar 2 mm by 4 are seen below the cube.
  for (const std::string scheme : {"gold", "Cornfield"}) {
    const auto result =
        run(folder, {"view", "a.scad", "-o", "a.png", "--layer", "0.25",
                     "--colorscheme", scheme, "--camera=3,3,5,90,0,270,40",
                     "--projection=o", "--imgsize=300,300"});
    ASSERT_EQ(result.status, 0) << result.errors;
    const Picture picture = read_png(folder.file("a.png"));
    double blue = 0;
    double part = 0;
    for (unsigned x = 0; x < picture.width; ++x) {
      bool is_below = false;
      for (unsigned y = 0; y < picture.height; ++y) {
        const bool is_support = is_blue(picture.at(x, y));
        // The cube is over the bar.
        ASSERT_FALSE(is_below && is_golden(picture.at(x, y))) << x << ' ' << y;
        is_below = is_below || is_support;
        blue += is_support ? 1 : 0;
        part += is_golden(picture.at(x, y)) ? 1 : 0;
      }
    }
    // Lower edges are dark.
    EXPECT_NEAR(blue / part, 8.0 / 36, 0.1 * 8 / 36) << scheme;
  }
}

TEST(View, ShowsLayersOfAFileInOneColor) {
  const TemporaryFolder folder;
  folder.write("a.scad", kCubeOnABar);
  ASSERT_EQ(run(folder, {"a.scad", "--layer", "0.25"}).status, 0);
  for (const char* const style : {"sheet", "stack"}) {
    ASSERT_EQ(
        run(folder, {"view", "a.slc", "-o", "a.png", "--style", style}).status,
        0);
    const Picture picture = read_png(folder.file("a.png"));
    EXPECT_EQ(count_pixels(picture, is_blue), 0) << style;
    EXPECT_GT(count_pixels(picture, is_golden), 1000) << style;
  }
}

// The faces of a pyramid have one direction each, however thick the layers are.
TEST(View, SlopesOfAStackAreSmooth) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cylinder(r1 = 10, r2 = 0, h = 12, $fn = 4);");
  const auto result =
      run(folder, {"view", "a.scad", "-o", "a.png", "--layer", "0.25",
                   "--camera=0,0,4,60,0,45,60", "--projection=o"});
  ASSERT_EQ(result.status, 0) << result.errors;
  const Picture picture = read_png(folder.file("a.png"));
  // A patch of the face towards the viewer, 14 layers high.
  const std::array<int, 3> middle = picture.at(256, 240);
  for (unsigned y = 200; y < 280; ++y) {
    for (unsigned x = 240; x < 272; ++x) {
      for (std::size_t channel = 0; channel < 3; ++channel) {
        ASSERT_NEAR(picture.at(x, y)[channel], middle[channel], 8)
            << x << ' ' << y;
      }
    }
  }
}

TEST(View, CamerasThatAreNoneAreAUsageFault) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(1);");
  for (const auto& [option, value] :
       {std::pair("--camera", "1,2,3"), std::pair("--camera", "1,1,1,1,1,1"),
        std::pair("--imgsize", "100"), std::pair("--imgsize", "100,5000"),
        std::pair("--projection", "x"), std::pair("--colorscheme", "Golden")}) {
    const auto result =
        run(folder, {"view", "a.scad", "-o", "a.png", option, value});
    EXPECT_EQ(result.status, 2) << option << value;
    EXPECT_NE(result.errors.find(option), std::string::npos) << result.errors;
  }
}

TEST(View, APageTakesNoOptionsOfPictures) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(1);");
  for (const auto& [option, value] :
       {std::pair("--style", "stack"), std::pair("--sheet", "3"),
        std::pair("--width", "400"), std::pair("--at", "0.5"),
        std::pair("--camera", "1,2,3,4,5,6")}) {
    const auto result =
        run(folder, {"view", "a.scad", "-o", "a.html", option, value});
    EXPECT_EQ(result.status, 2) << option;
    EXPECT_NE(result.errors.find("a page takes --min-feature only"),
              std::string::npos)
        << result.errors;
  }
  EXPECT_EQ(run(folder, {"view", "a.scad", "-o", "a.html"}).status, 0);
  EXPECT_EQ(folder.entry_count(), 2U);
}

TEST(View, AStackSaysWhichPackageIsMissing) {
  // Stand-ins that are no libraries hide the installed ones.
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(1);");
  for (const char* const name : {"libOSMesa.so.6", "libOSMesa.so.8"}) {
    folder.write(name, "no library");
  }
  std::vector<std::string> words =
      command({"view", "a.scad", "-o", "a.png", "--style", "stack"});
  words.insert(words.begin(),
               {"/usr/bin/env", "LD_LIBRARY_PATH=" + folder.path()});
  const auto result = support::run_process(words, folder.path());
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.errors.find("Install the package libosmesa6."),
            std::string::npos)
      << result.errors;
  EXPECT_EQ(folder.entry_count(), 3U);
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

// Whether all pixels of the column, below the title, are as that in the corner.
bool is_paper(const Picture& picture, unsigned x) {
  for (unsigned y = 62; y < picture.height; ++y) {
    const unsigned char* const pixel =
        picture.rgb.data() + 3 * (std::size_t{y} * picture.width + x);
    if (!std::equal(pixel, pixel + 3, picture.rgb.data())) return false;
  }
  return true;
}

TEST(View, LabelsOfNarrowTilesStayUnderThem) {
  const TemporaryFolder folder;
  folder.write("a.scad", "translate([0, 0, 1000]) cube([3, 9, 2.1]);");
  const auto result = run(folder, {"view", "a.scad", "-o", "a.png", "--layer",
                                   "0.1", "--width", "900"});
  ASSERT_EQ(result.status, 0) << result.errors;
  const Picture picture = read_png(folder.file("a.png"));
  // The margins beside the seven columns are free.
  unsigned margins = 0;
  for (unsigned x = 1; x < picture.width; ++x) {
    margins += is_paper(picture, x) && !is_paper(picture, x - 1) ? 1 : 0;
  }
  EXPECT_EQ(margins, 7U);
}

TEST(View, ALayerAloneFillsThePicture) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube([40, 40, 2]); cube([10, 5, 4]);");
  ASSERT_EQ(run(folder, {"a.scad", "--layer", "1"}).status, 0);
  const auto golden_pixels = [&](std::vector<std::string> which) {
    std::vector<std::string> words = {"view", "a.slc", "-o", "a.png"};
    words.insert(words.end(), which.begin(), which.end());
    const auto result = run(folder, words);
    EXPECT_EQ(result.status, 0) << result.errors;
    const Picture picture = read_png(folder.file("a.png"));
    EXPECT_EQ(picture.width, 1200U);
    return golden_share(picture) * picture.width * picture.height;
  };
  // The field is 1164 pixels wide and the layer 48 less on either side; the
  // outline is darker than gold, but not less red.
  const double width = 1164 - 2 * 48;
  EXPECT_NEAR(golden_pixels({"--layer-number", "3"}) / (width * width / 2), 1,
              0.01);
  EXPECT_NEAR(golden_pixels({"--at", "3.9"}) / (width * width / 2), 1, 0.01);
  EXPECT_NEAR(golden_pixels({"--at", "0"}) / (width * width), 1, 0.01);
}

TEST(View, ASmallPictureHasRoomForAFlatLayer) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube([40, 10, 1]);");
  const auto result = run(folder, {"view", "a.scad", "--layer", "1", "--at",
                                   "0.5", "--width", "200", "-o", "a.png"});
  ASSERT_EQ(result.status, 0) << result.errors;
  const Picture picture = read_png(folder.file("a.png"));
  // The field is 164 pixels wide and the layer a tenth of that less on either
  // side; there are 10 * 40 mm² of gold or its outline.
  const double pixels_per_mm = 0.8 * 164 / 40;
  EXPECT_NEAR(golden_share(picture) * picture.width * picture.height /
                  (400 * pixels_per_mm * pixels_per_mm),
              1, 0.05);
}

// Numbers lie farther apart there than lines of the grid would.
TEST(View, ALayerAsSmallAsItsRoundingIsDrawn) {
  const TemporaryFolder folder;
  folder.write("a.layers.json",
               R"({"units":"mm","layers":[{"z":1,"contours":[{"points":)"
               "[[999999999,999999999],[999999999.0000001,999999999],"
               "[999999999.0000001,999999999.0000001]]}]}]}");
  const auto result = run(folder, {"view", "a.layers.json", "--at", "1", "-o",
                                   "a.png", "--max-time", "20"});
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_EQ(read_png(folder.file("a.png")).width, 1200U);
}

std::size_t red_pixels(const Picture& picture) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
    if (picture.rgb[i] > 150 && picture.rgb[i + 1] < 60) ++count;
  }
  return count;
}

TEST(View, ThinWallsOfALayerAreMarked) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube([10, 0.3, 1]); cube([3, 3, 1]);");
  const auto marks = [&](const char* width) {
    const auto result = run(folder, {"view", "a.scad", "-o", "a.png", "--at",
                                     "0.5", "--min-feature", width});
    EXPECT_EQ(result.status, 0) << result.errors;
    return red_pixels(read_png(folder.file("a.png")));
  };
  EXPECT_EQ(marks("0.25"), 0U);
  // 7 mm of middle line at 106.8 pixels per mm, 4 pixels wide.
  EXPECT_GT(marks("0.35"), 7 * 106 * 3);
}

TEST(View, ALayerThatIsNotThereIsAnError) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(1);");
  auto result = run(folder, {"view", "a.scad", "-o", "a.png", "--at", "1.5"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.errors.find("no layer at z 1.5 mm: the layers reach from 0 "
                               "to 1"),
            std::string::npos)
      << result.errors;
  result =
      run(folder, {"view", "a.scad", "-o", "a.png", "--layer-number", "21"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.errors.find("no layer 21: there are 20"), std::string::npos)
      << result.errors;
  EXPECT_EQ(folder.entry_count(), 1U);
}

}  // namespace
}  // namespace lamina::cli
