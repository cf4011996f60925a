#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/lamina.h"
#include "tests/support/text.h"

namespace lamina::cli {
namespace {

using nlohmann::json;
using support::has;
using support::TemporaryFolder;

// `inspect` ends with 1 and says all of these.
void expect_defects(const TemporaryFolder& folder, const std::string& file,
                    const std::vector<std::string>& words) {
  const auto result = run(folder, {"inspect", file});
  EXPECT_EQ(result.status, 1);
  for (const std::string& part : words) {
    EXPECT_TRUE(has(result.output, part)) << part << "\n" << result.output;
  }
}

TEST(Inspect, ASoundFileEndsWithZeroAndShowsItsFigures) {
  const TemporaryFolder folder;
  folder.write("a.scad",
               "difference() { cube([4, 5, 2]);"
               "translate([1, 1, -1]) cube([1, 1, 9]); }");
  ASSERT_EQ(run(folder, {"a.scad", "--layer", "0.5"}).status, 0);
  const auto result = run(folder, {"inspect", "a.slc"});
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_TRUE(has(result.output, "layers    4")) << result.output;
  EXPECT_TRUE(has(result.output, "loops     8, 4 of them holes; 32 vertices"));
  EXPECT_TRUE(has(result.output, "volume    38.000000 mm³"));
  EXPECT_TRUE(has(result.output, "defects   none"));
}

TEST(Inspect, LongFilesAreSummarisedUnlessAllIsWanted) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(10);");
  ASSERT_EQ(run(folder, {"a.scad"}).status, 0);
  const auto lines = [](const std::string& text) {
    return std::count(text.begin(), text.end(), '\n');
  };
  EXPECT_LT(lines(run(folder, {"inspect", "a.slc"}).output), 60);
  EXPECT_GT(lines(run(folder, {"inspect", "--all", "a.slc"}).output), 200);
}

TEST(Inspect, ADefectEndsWithOne) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(2);");
  ASSERT_EQ(run(folder, {"a.scad", "--layer", "2"}).status, 0);
  std::string bytes = support::read_file(folder.file("a.slc"));
  bytes[bytes.size() - 9] = 0x41;  // of the last vertex
  folder.write("b.slc", bytes);
  expect_defects(folder, "b.slc", {"is not closed"});
}

TEST(Inspect, ALoopThatItsReaderClosedIsADefect) {
  const TemporaryFolder folder;
  folder.write("a.cli",
               "$$HEADERSTART\n$$ASCII\n$$UNITS/1\n$$HEADEREND\n"
               "$$GEOMETRYSTART\n$$LAYER/1\n$$POLYLINE/1,1,3,0,0,5,0,5,5\n"
               "$$GEOMETRYEND\n");
  expect_defects(folder, "a.cli",
                 {"layer 1 at z 1: a loop is not closed in the file, near x 0 "
                  "y 0\n"});
}

TEST(Inspect, ALoopThatItsReaderLeftOutIsADefect) {
  const TemporaryFolder folder;
  folder.write("a.layers.json",
               R"({"layers":[{"z":0,"bottom":0,"top":1,"contours":[)"
               R"({"points":[[0,0],[5,0],[5,5]]}]},)"
               R"({"z":1,"bottom":1,"top":2,"contours":[)"
               R"({"points":[[7,8],[9,8]]},{"points":[[3,3]]}]}]})");
  expect_defects(folder, "a.layers.json",
                 {"layer 2 at z 1: a loop has fewer than 3 points, near x 7 y "
                  "8 (the first of 2)\n",
                  "defects   2\n"});
  const auto checked = run(folder, {"check", "a.layers.json"});
  EXPECT_TRUE(has(checked.errors, "2 loops of fewer than 3 points"))
      << checked.errors;
}

TEST(Inspect, NoCommandTakesAFileWithoutLayers) {
  const TemporaryFolder folder;
  folder.write("a.layers.json", "{\"layers\": []}");
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{
           {"inspect", "a.layers.json"},
           {"check", "a.layers.json"},
           {"compare", "a.layers.json", "a.layers.json"},
           {"view", "a.layers.json", "-o", "a.png"}}) {
    const auto result = run(folder, words);
    EXPECT_EQ(result.status, 1) << words.front();
    EXPECT_EQ(result.errors, "error: a.layers.json: it holds no layers\n");
  }
}

TEST(Inspect, WhatIsNoSlcEndsWithOne) {
  const TemporaryFolder folder;
  folder.write("a.slc", "Slice V0.2");
  const auto result = run(folder, {"inspect", "a.slc"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(has(result.errors, "Stratasys")) << result.errors;
}

constexpr const char* kPlate =
    "translate([1, 2, 3]) difference() { cube([20, 10, 5]);"
    "translate([5, 2, -1]) cube([5, 5, 9]); }";

json inspected(const TemporaryFolder& folder, std::vector<std::string> words) {
  words.insert(words.begin(), "inspect");
  words.push_back("--json");
  const auto result = run(folder, words);
  EXPECT_EQ(result.status, 0) << result.errors;
  return json::parse(result.output);
}

TEST(Inspect, MeasuresThePart) {
  const TemporaryFolder folder;
  folder.write("a.scad", kPlate);
  ASSERT_EQ(run(folder, {"a.scad", "--layer", "0.5"}).status, 0);
  const json found = inspected(folder, {"a.slc"});
  const double volume = (20 * 10 - 5 * 5) * 5;  // mm³
  EXPECT_NEAR(found.at("volume_mm3").get<double>(), volume, 1e-3);
  EXPECT_EQ(found.at("box_mm").at("low"), json({1.0, 2.0, 3.0}));
  EXPECT_EQ(found.at("box_mm").at("high"), json({21.0, 12.0, 8.0}));
  EXPECT_EQ(found.at("layers").size(), 10U);
  EXPECT_NEAR(found.at("layers")[3].at("area_mm2").get<double>(), 175, 1e-4);
  EXPECT_NEAR(found.at("layers")[3].at("perimeter_mm").get<double>(), 80, 1e-4);
  EXPECT_EQ(found.at("defects"), 0);
  const auto text = run(folder, {"inspect", "a.slc"}).output;
  EXPECT_TRUE(has(text, "(20.0000 x 10.0000 x 5.0000 mm)")) << text;
}

// 0.875 cm³ of each metal.
TEST(Inspect, WeighsThePart) {
  const TemporaryFolder folder;
  folder.write("a.scad", kPlate);
  ASSERT_EQ(run(folder, {"a.scad", "--layer", "0.5"}).status, 0);
  const json found = inspected(folder, {"a.slc"});
  const json& weights = found.at("weight_g");
  EXPECT_NEAR(weights.at("yellow gold 750 (18 k)").get<double>(), 13.475, 1e-4);
  EXPECT_NEAR(weights.at("sterling silver (925)").get<double>(), 9.065, 1e-4);
  EXPECT_NEAR(weights.at("platinum 950").get<double>(), 18.1125, 1e-4);
  const auto text = run(folder, {"inspect", "a.slc"}).output;
  EXPECT_TRUE(has(text, "13.475 g  yellow gold 750 (18 k) (15.4 g/cm³)"))
      << text;
}

TEST(Inspect, AllFormatsAndTheDesignItselfTellTheSame) {
  const TemporaryFolder folder;
  folder.write("a.scad", "sphere(4, $fn = 40);");
  const std::vector<std::string> options = {"--layer", "0.1", "--adaptive",
                                            "0.2"};
  std::vector<std::string> words = {"a.scad"};
  words.insert(words.end(), options.begin(), options.end());
  const json design = inspected(folder, words);
  ASSERT_GT(design.at("layers").size(), 20U);
  for (const std::string format :
       {"slc", "cli", "svg", "slices.3mf", "layers.json"}) {
    std::vector<std::string> slice = words;
    slice.insert(slice.end(), {"-o", "b." + format});
    ASSERT_EQ(run(folder, slice).status, 0);
    const json file = inspected(folder, {"b." + format});
    ASSERT_EQ(file.at("layers").size(), design.at("layers").size()) << format;
    EXPECT_EQ(file.at("vertices"), design.at("vertices")) << format;
    for (std::size_t i = 0; i < design.at("layers").size(); ++i) {
      EXPECT_NEAR(file.at("layers")[i].at("area_mm2").get<double>(),
                  design.at("layers")[i].at("area_mm2").get<double>(), 1e-3)
          << format << ' ' << i;
    }
    // .svg has no sides, so its volume is a guess.
    EXPECT_NEAR(file.at("volume_mm3").get<double>(),
                design.at("volume_mm3").get<double>(),
                format == "svg" ? 10 : 0.01)
        << format;
  }
}

TEST(Inspect, ADesignThatFailsEndsWithOne) {
  const TemporaryFolder folder;
  folder.write("a.scad", "assert(false); cube(1);");
  const auto result = run(folder, {"inspect", "a.scad"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.output, "");
  EXPECT_TRUE(has(result.errors, "Assertion")) << result.errors;
}

}  // namespace
}  // namespace lamina::cli
