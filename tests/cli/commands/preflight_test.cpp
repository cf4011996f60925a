// lamina preflight, on pieces whose measures are known.

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/lamina.h"
#include "tests/cli/png_picture.h"
#include "tests/support/text.h"

namespace lamina::cli {
namespace {

using nlohmann::json;
using support::has;
using support::read_file;
using support::TemporaryFolder;

constexpr double kSilver = 10.36e-3;  // [g/mm³]

// Reads what base64() of the program wrote.
std::string from_base64(std::string_view text) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::size_t bits = 0;
  unsigned held = 0;
  for (const char c : text.substr(0, text.find('='))) {
    held = held << 6 | static_cast<unsigned>(kDigits.find(c));
    if ((bits += 6) < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(held >> bits & 255);
  }
  return bytes;
}

struct Found {
  json report;
  int status = 0;
};

Found preflight_file(const TemporaryFolder& folder, const std::string& path,
                     const std::vector<std::string>& options) {
  std::vector<std::string> words = {"preflight",       path, "--metal",
                                    "sterling-silver", "-o", "o.json"};
  words.insert(words.end(), options.begin(), options.end());
  const int status = run(folder, words).status;
  return {json::parse(read_file(folder.file("o.json"))), status};
}

Found preflight(const std::string& design,
                const std::vector<std::string>& options = {}) {
  const TemporaryFolder folder;
  folder.write("a.scad", design);
  return preflight_file(folder, "a.scad", options);
}

Found preflight_example(const std::string& name,
                        const std::vector<std::string>& options = {}) {
  return preflight_file(TemporaryFolder(), LAMINA_EXAMPLES "/" + name, options);
}

TEST(Preflight, PassesAThickPieceAndWeighsIt) {
  const auto [report, status] = preflight("cube(10);");
  EXPECT_EQ(status, 0);
  EXPECT_NEAR(report["volume_mm3"].get<double>(), 1000, 1e-6);
  EXPECT_NEAR(report["grams"].get<double>(), 1000 * kSilver, 1e-6);
  EXPECT_NEAR(report["weights_g"]["platinum-950"].get<double>() / 1000, 21.4e-3,
              1e-3);
  EXPECT_NEAR(report["surface_mm2"].get<double>(), 600, 9);
  EXPECT_NEAR(report["thickest_mm"].get<double>(), 10, 0.05);
  EXPECT_TRUE(report["too_thin"].empty());
  EXPECT_TRUE(report["unfed"].empty());
  EXPECT_FALSE(report.contains("inner_diameter_mm"));
}

// A plate is found however it lies.
TEST(Preflight, FindsAThinPlate) {
  for (const char* turn : {"[0, 0, 0]", "[90, 0, 0]", "[35, 20, 0]"}) {
    const auto [report, status] = preflight(
        "rotate(" + std::string(turn) + ") cube([9, 7, 0.5], center = true);");
    EXPECT_EQ(status, 1);
    ASSERT_EQ(report["too_thin"].size(), 1U) << turn;
    const json& wall = report["too_thin"][0];
    EXPECT_EQ(wall["kind"], "wall");
    EXPECT_NEAR(wall["thickness_mm"].get<double>(), 0.5, 1e-3);
    EXPECT_EQ(wall["least_mm"], 0.8);
    // Without the rim, where balls are smaller.
    EXPECT_NEAR(wall["area_mm2"].get<double>(), 8.5 * 6.5, 4);
    EXPECT_EQ(wall["lines"],
              "a.scad:1:" + std::to_string(10 + std::string(turn).size()));
  }
}

TEST(Preflight, AsksLessOfAWire) {
  const auto [thin, status] =
      preflight("rotate([40, 0, 0]) cylinder(d = 0.5, h = 9, $fn = 24);");
  EXPECT_EQ(status, 1);
  ASSERT_EQ(thin["too_thin"].size(), 1U);
  EXPECT_EQ(thin["too_thin"][0]["kind"], "wire");
  EXPECT_NEAR(thin["too_thin"][0]["thickness_mm"].get<double>(), 0.5, 0.01);
  EXPECT_EQ(preflight("rotate([40, 0, 0]) cylinder(d = 0.6, h = 9, $fn = 24);")
                .status,
            0);
}

// OpenSCAD gives it five sides: their inscribed circle is what is thin, here up
// to a third of the distance of rays.
TEST(Preflight, FindsAWireOfFewSides) {
  for (const char* turn : {"[0, 0, 0]", "[40, 0, 0]", "[0, 90, 20]"}) {
    for (const double diameter : {0.3, 0.5}) {
      const json thin =
          preflight("sphere(3); rotate(" + std::string(turn) +
                    ") cylinder(d = " + std::to_string(diameter) + ", h = 9);")
              .report["too_thin"];
      ASSERT_EQ(thin.size(), 1U) << turn << diameter;
      EXPECT_EQ(thin[0]["kind"], "wire");
      EXPECT_NEAR(thin[0]["thickness_mm"].get<double>(),
                  diameter * std::cos(std::numbers::pi / 5), 0.04);
    }
  }
}

TEST(Preflight, FindsANarrowGap) {
  const auto [report, status] = preflight(
      "difference() { cube([8, 8, 3]); translate([4, -1, 1]) cube([0.2, 10, "
      "3]); }");
  EXPECT_EQ(status, 1);
  ASSERT_EQ(report["too_thin"].size(), 1U);
  EXPECT_EQ(report["too_thin"][0]["kind"], "gap");
  EXPECT_NEAR(report["too_thin"][0]["thickness_mm"].get<double>(), 0.2, 1e-3);
}

// An edge of a wedge has no thickness of its own.
TEST(Preflight, CountsEdgesButDoesNotListThem) {
  const auto [report, status] =
      preflight("linear_extrude(6) polygon([[0, 0], [12, 1.5], [12, -1.5]]);");
  EXPECT_EQ(status, 0);
  EXPECT_EQ(report["edges"], 1);
}

TEST(Preflight, KnowsTheSizeOfARing) {
  for (const char* turn : {"[0, 0, 0]", "[90, 0, 0]", "[0, 90, 0]"}) {
    const json report =
        preflight("rotate(" + std::string(turn) +
                  ") difference() { cylinder(d = 21, h = 4, $fn = 180, center "
                  "= true); cylinder(d = 17.35, h = 9, $fn = 180, center = "
                  "true); }")
            .report;
    const double inner = 17.35 * std::cos(std::numbers::pi / 180);
    EXPECT_NEAR(report["inner_diameter_mm"].get<double>(), inner, 0.01);
    EXPECT_NEAR(report["ring_size_eu"].get<double>(), std::numbers::pi * inner,
                0.04);
    EXPECT_NEAR(report["ring_size_us"].get<double>(), 7.03, 0.02);
  }
}

constexpr const char* kFineDumbbell =
    "for (x = [-8, 8]) translate([x, 0, 0]) sphere(3, $fn = 96);\nrotate([0, "
    "90, 0]) cylinder(r = 1, h = 16, center = true, $fn = 96);";

TEST(Preflight, NamesWhatMetalReachesThroughAThinnerPlace) {
  const json one = preflight(kFineDumbbell, {"--gate", "-11,0,0"}).report;
  ASSERT_EQ(one["unfed"].size(), 1U);
  EXPECT_NEAR(one["unfed"][0]["place"][0].get<double>(), 8, 0.1);
  EXPECT_NEAR(one["unfed"][0]["thickness_mm"].get<double>(), 6, 0.05);
  EXPECT_NEAR(one["unfed"][0]["neck_mm"].get<double>(), 2, 0.1);
  EXPECT_EQ(one["unfed"][0]["lines"], "a.scad:2:20");
  const json both =
      preflight(kFineDumbbell, {"--gate", "-11,0,0", "--gate", "11,0,0,6"})
          .report;
  EXPECT_TRUE(both["unfed"].empty());
}

// The pictures of a page, in its order.
std::vector<Picture> pictures_of(const std::string& design,
                                 const std::vector<std::string>& options) {
  const TemporaryFolder folder;
  folder.write("a.scad", design);
  std::vector<std::string> words = {"preflight",       "a.scad", "--metal",
                                    "sterling-silver", "-o",     "o.html"};
  words.insert(words.end(), options.begin(), options.end());
  EXPECT_EQ(run(folder, words).errors, "");
  const std::string page = read_file(folder.file("o.html"));
  constexpr std::string_view kBegin = "data:image/png;base64,";
  std::vector<Picture> pictures;
  for (std::size_t at = 0; (at = page.find(kBegin, at)) != std::string::npos;) {
    at += kBegin.size();
    pictures.push_back(read_png(folder.write(
        "o.png", from_base64(page.substr(at, page.find('"', at) - at)))));
  }
  return pictures;
}

struct Painted {
  std::size_t reached = 0;  // blue pixels
  std::size_t apart = 0;    // orange pixels, and stripes in brown
  double left = 1;          // of what is orange, as a share of the picture
};

Painted count_painted(const Picture& picture) {
  Painted count;
  for (unsigned y = 0; y < picture.height; ++y) {
    for (unsigned x = 0; x < picture.width; ++x) {
      const auto [red, green, blue] = picture.at(x, y);
      if (blue > red + 12) ++count.reached;
      if (red > blue + 12) {
        ++count.apart;
        count.left =
            std::min(count.left, static_cast<double>(x) / picture.width);
      }
    }
  }
  return count;
}

// The far ball and half of the rod freeze by themselves.
TEST(Preflight, PaintsWhatMetalDoesNotReach) {
  const auto pictures = pictures_of(kFineDumbbell, {"--gate", "-11,0,0"});
  ASSERT_EQ(pictures.size(), 3U);
  for (const std::size_t view : {0U, 2U}) {  // from the front and from above
    const Painted count = count_painted(pictures[view]);
    const auto all = static_cast<double>(count.reached + count.apart);
    EXPECT_GT(all, 5000);
    // A ball has 9 π mm² of the picture, the rod between them 4 (8 - √8); the
    // rod is as thick everywhere, so that it may go with either ball, up to its
    // middle.
    const double ball = 9 * std::numbers::pi;
    const double rod = 4 * (8 - std::sqrt(8));
    const double share = static_cast<double>(count.apart) / all;
    EXPECT_GT(share, ball / (2 * ball + rod) - 0.02);
    EXPECT_LT(share, 0.52);
    EXPECT_GT(count.left, 0.48);
  }
  // From the right the far ball hides all else.
  const Painted right = count_painted(pictures[1]);
  EXPECT_GT(right.apart, 2000U);
  EXPECT_LT(right.reached, right.apart / 50);
}

TEST(Preflight, PaintsNoPartOfAConeThatIsFedAtItsBase) {
  for (const Picture& picture :
       pictures_of("cylinder(r1 = 5, r2 = 0, h = 12, $fn = 96);",
                   {"--gate", "0,0,0"})) {
    const Painted count = count_painted(picture);
    EXPECT_GT(count.reached, 5000U);
    EXPECT_EQ(count.apart, 0U);
  }
}

TEST(Preflight, FindsAShallowEngraving) {
  for (const auto& [depth, status] : {std::pair{0.3, 1}, {0.5, 0}}) {
    const auto found =
        preflight("difference() { cube([8, 8, 3]); translate([2, 2, 3 - " +
                  std::to_string(depth) + "]) cube([4, 0.5, 3]); }");
    EXPECT_EQ(found.status, status);
    const json& shallow = found.report["too_shallow"];
    ASSERT_EQ(shallow.size(), static_cast<std::size_t>(status));
    if (status == 0) continue;
    EXPECT_NEAR(shallow[0]["depth_mm"].get<double>(), depth, 1e-6);
    EXPECT_NEAR(shallow[0]["width_mm"].get<double>(), 0.5, 1e-6);
    EXPECT_EQ(shallow[0]["least_mm"], 0.5);
    EXPECT_EQ(shallow[0]["lines"], "a.scad:1:65");
  }
}

TEST(Preflight, MeasuresTheLettersOfASignet) {
  for (const double depth : {0.3, 0.5}) {
    const json shallow =
        preflight_example("signet.scad",
                          {"-D", "depth=" + std::to_string(depth)})
            .report["too_shallow"];
    EXPECT_EQ(shallow.empty(), depth == 0.5);
    for (const json& one : shallow) {
      EXPECT_NEAR(one["depth_mm"].get<double>(), depth, 1e-3);
    }
  }
}

TEST(Preflight, ListsStones) {
  const json report =
      preflight(
          "/* [Halo] */\n// diameter of the gems\nsmall = 2; // [1:3]\n/* "
          "[Centre stone] */\n// weight of the diamond [carat]\nweight = 1;\n"
          "stone_d = 3;\n// share of the diameter\nbite = 0.1;\n/* [Band] */"
          "\n// metal beside the stones\nedge = 0.4;\narrangement = 3;\n"
          "cube(9);")
          .report;
  const json& stones = report["stones"];
  ASSERT_EQ(stones.size(), 4U);
  EXPECT_EQ(stones[0]["name"], "small");
  EXPECT_NEAR(stones[0]["carats"].get<double>(), 2 * 2 * 1.2 * 0.0061, 1e-12);
  // A brilliant of one carat is some 6.5 mm wide.
  EXPECT_EQ(stones[1]["carats"], 1);
  EXPECT_NEAR(stones[1]["diameter_mm"].get<double>(), 6.49, 0.01);
  EXPECT_EQ(stones[2]["diameter_mm"], 3);
  EXPECT_EQ(stones[3]["name"], "bite");
  EXPECT_FALSE(stones[3].contains("carats"));
}

TEST(Preflight, ListsTheStonesOfExamples) {
  EXPECT_EQ(preflight_example("solitaire.scad").report["stones"][0]["carats"],
            1);
  EXPECT_EQ(
      preflight_example("eternity.scad").report["stones"][0]["diameter_mm"],
      2.3);
}

TEST(Preflight, WritesAPageThatNeedsNoOtherFile) {
  const TemporaryFolder folder;
  folder.write("<i>.scad",
               "/* [Ring] */\n// finger\nsize = 54; // [40:70]\ncube([8, 8, "
               "0.5]); translate([0, 0, 0]) cube(4);");
  const auto result = run(folder, {"preflight", "<i>.scad", "--metal",
                                   "sterling-silver", "-o", "o.html"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.output, "1 wall is too thin")) << result.output;
  const std::string page = read_file(folder.file("o.html"));
  EXPECT_TRUE(has(page, "&lt;i&gt;.scad"));
  EXPECT_FALSE(has(page, "<i>"));
  EXPECT_TRUE(has(page, "Not ready: 1 wall is too thin"));
  EXPECT_TRUE(has(page, "<code>size</code></th><td>54</td><td>finger</td>"));
  EXPECT_FALSE(has(page, "http"));
  std::size_t pictures = 0;
  for (std::size_t at = 0;
       (at = page.find("data:image/png;base64,iVBOR", at)) != std::string::npos;
       ++at) {
    ++pictures;
  }
  EXPECT_EQ(pictures, 3U);
}

TEST(Preflight, NeedsAMetal) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(5);");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"preflight", "a.scad"},
        {"preflight", "a.scad", "--material", "standard-resin"}}) {
    const auto result = run(folder, words);
    EXPECT_NE(result.status, 0);
    EXPECT_TRUE(has(result.errors, "preflight needs a metal")) << result.errors;
  }
  folder.write("n.json",
               R"({"name": "tin", "density": 7.3, "casting": {"wall_mm": 1,
                   "wire_mm": 1, "gap_mm": 0, "finishing_mm": 0}})");
  const auto bad = run(folder, {"preflight", "a.scad", "--metal", "n.json"});
  EXPECT_EQ(bad.status, 1);
  EXPECT_TRUE(has(bad.errors, "gap_mm")) << bad.errors;
  folder.write("m.json", R"({"name": "tin", "density": 7.3})");
  const auto result = run(folder, {"preflight", "a.scad", "--metal", "m.json"});
  EXPECT_EQ(result.status, 2);
  EXPECT_TRUE(has(result.errors, "says nothing of its castings"))
      << result.errors;
}

}  // namespace
}  // namespace lamina::cli
