// Which layers there are: --adaptive, --layers, --axis auto, --place-on-bed.

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/lamina.h"
#include "tests/support/text.h"

namespace lamina::cli {
namespace {

using nlohmann::json;
using support::TemporaryFolder;

constexpr const char* kBall = "translate([9, 1, 2]) sphere(3, $fn = 60);";

using support::has;

// The layers of a.scad under these options.
json layers_of(const TemporaryFolder& folder,
               std::vector<std::string> options) {
  options.insert(options.end(), {"a.scad", "-q", "-o", "a.layers.json"});
  const auto result = run(folder, options);
  EXPECT_EQ(result.status, 0) << result.errors;
  return json::parse(support::read_file(folder.file("a.layers.json")))
      .at("layers");
}

TEST(Layers, ARangeIsCutOutOfAll) {
  const TemporaryFolder folder;
  folder.write("a.scad", kBall);
  const json all = layers_of(folder, {});
  ASSERT_EQ(all.size(), 120U);
  const auto expect_range = [&](const std::string& range, std::size_t first,
                                std::size_t last) {
    const json some = layers_of(folder, {"--layers", range});
    const json expected(all.begin() + static_cast<std::ptrdiff_t>(first - 1),
                        all.begin() + static_cast<std::ptrdiff_t>(last));
    EXPECT_EQ(some, expected) << range;
  };
  expect_range("3:7", 3, 7);
  expect_range("118:", 118, 120);
  expect_range(":2", 1, 2);
  expect_range("64", 64, 64);
  expect_range("119:1000", 119, 120);
}

TEST(Layers, NumbersAreThoseOfInspect) {
  const TemporaryFolder folder;
  // Whatever is empty below does not count.
  folder.write("a.scad",
               "difference() { cube([9, 9, 5]); translate([-1, -1, -1]) "
               "cube([11, 11, 3]); translate([-1, -1, 3]) cube([11, 11, 1]); "
               "}");
  ASSERT_EQ(run(folder, {"a.scad", "--layer", "0.5"}).status, 0);
  const std::string all = run(folder, {"inspect", "a.slc"}).output;
  EXPECT_TRUE(has(all, "layers    6, 2 of them empty")) << all;
  ASSERT_EQ(run(folder, {"a.scad", "--layer", "0.5", "--layers", "2:3"}).status,
            0);
  const std::string some = run(folder, {"inspect", "a.slc"}).output;
  EXPECT_TRUE(has(some, "layers    2, 1 of them empty; top of the part z 3.5"))
      << some;
}

TEST(Layers, RangesThatAreNoneAreRefused) {
  const TemporaryFolder folder;
  folder.write("a.scad", kBall);
  for (const char* range :
       {"", ":", "a", "3-4", "0:3", "7:3", "1:2:3", "-1:"}) {
    const auto result =
        run(folder, {"a.scad", "--layers", range, "-o", "b.slc"});
    const bool is_everything = std::string(range) == ":";
    EXPECT_EQ(result.status, is_everything ? 0 : 2) << range;
  }
  const auto beyond = run(folder, {"a.scad", "--layers", "121:"});
  EXPECT_EQ(beyond.status, 1);
  EXPECT_TRUE(has(beyond.errors,
                  "There is no layer 121: the layers are 1 to "
                  "120"))
      << beyond.errors;
}

TEST(Layers, AdaptiveOnesAreInTheTableOfASlc) {
  const TemporaryFolder folder;
  folder.write("a.scad", kBall);
  const json layers =
      layers_of(folder, {"--adaptive", "0.06", "--layer", "0.03"});
  EXPECT_LT(layers.size(), 200U);
  ASSERT_EQ(
      run(folder, {"a.scad", "--adaptive", "0.06", "--layer", "0.03"}).status,
      0);
  const auto result = run(folder, {"inspect", "a.slc"});
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_TRUE(has(result.output, "layers of 0.06\n")) << result.output;
  EXPECT_TRUE(has(result.output, "layers of 0.12\n")) << result.output;
  double volume = 0;
  for (const json& layer : layers) {
    volume += layer.at("top").get<double>() - layer.at("bottom").get<double>();
  }
  EXPECT_NEAR(volume, 6, 0.02);
}

TEST(Layers, AFolderOfImagesTellsTheThicknessOfEach) {
  const TemporaryFolder folder;
  folder.write("a.scad", kBall);
  const std::vector<std::string> options = {"--adaptive", "0.3", "--layer",
                                            "0.2"};
  const json layers = layers_of(folder, options);
  std::vector<std::string> words = {"a.scad", "-o", "a.png/"};
  words.insert(words.end(), options.begin(), options.end());
  ASSERT_EQ(run(folder, words).status, 0);
  const json index =
      json::parse(support::read_file(folder.file("a.png/index.json")));
  EXPECT_EQ(index.at("layer_thickness"), 0);
  ASSERT_EQ(index.at("layers").size(), layers.size());
  for (std::size_t i = 0; i < layers.size(); ++i) {
    EXPECT_NEAR(index.at("layers")[i].at("thickness").get<double>(),
                layers[i].at("top").get<double>() -
                    layers[i].at("bottom").get<double>(),
                1e-9);
  }
}

TEST(Layers, WhatCannotHoldSeveralThicknessesSaysSo) {
  const TemporaryFolder folder;
  folder.write("a.scad", kBall);
  const auto refused = [&](std::vector<std::string> options,
                           const std::string& words) {
    options.insert(options.begin(), "a.scad");
    const auto result = run(folder, options);
    EXPECT_EQ(result.status, 2);
    EXPECT_TRUE(has(result.errors, words)) << result.errors;
  };
  refused({"--adaptive", "0.05", "-o", "a.sl1"},
          "need layers of one thickness");
  refused({"--adaptive", "0.05", "-o", "a.zip"},
          "need layers of one thickness");
  refused({"--adaptive", "0.05", "--heights", "1,2"}, "different things");
  refused({"--max-layer", "0.2"}, "--max-layer needs --adaptive");
  refused({"--adaptive", "0.05", "--max-layer", "0.01"},
          "--max-layer must not be less than --layer");
  refused({"--adaptive", "0"}, "--adaptive");
  refused({"--adaptive", "0.05", "--contour", "paper", "--sampler", "gl"},
          "one thickness");
}

TEST(Layers, AWarningCountsHeightsOutsideTheDesign) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube(10);");
  const auto some =
      run(folder, {"a.scad", "--heights", "-1,0,5,10,254", "-o", "some.slc"});
  EXPECT_EQ(some.status, 0);
  EXPECT_TRUE(has(some.errors,
                  "2 of 5 heights outside the design, which reaches from z 0 "
                  "to 10 mm"))
      << some.errors;
  const auto none =
      run(folder, {"a.scad", "--heights", "0,5,10", "-o", "none.slc"});
  EXPECT_FALSE(has(none.errors, "outside the design")) << none.errors;
  const auto one =
      run(folder, {"a.scad", "--heights", "11", "-o", "one.slc", "--strict"});
  EXPECT_TRUE(has(one.errors, "1 of 1 height outside")) << one.errors;
  EXPECT_EQ(one.status, 1);
}

TEST(Layers, AnyNumberOfThreadsGivesTheSameAdaptiveLayers) {
  const TemporaryFolder folder;
  folder.write("a.scad", kBall);
  EXPECT_EQ(layers_of(folder, {"--adaptive", "0.05", "--threads", "1"}),
            layers_of(folder, {"--adaptive", "0.05", "--threads", "3"}));
}

// Sections and outlines have no thickness that a place could be too low for.
TEST(ThinPlaces, AreListedOfOutlinesAndSections) {
  const TemporaryFolder folder;
  folder.write("outline.scad", "square([5, 0.03]);");
  folder.write("solid.scad", "cube([5, 0.03, 9]);");
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{
           {"outline.scad", "-o", "a.svg"},
           {"solid.scad", "-o", "b.svg", "--heights", "1"}}) {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"--min-feature", "0.5"});
    const auto result = run(folder, all);
    EXPECT_NE((result.output + result.errors).find("1 wall, 0 gaps"),
              std::string::npos)
        << result.output << result.errors;
    EXPECT_EQ((result.output + result.errors).find("0 walls"),
              std::string::npos)
        << result.output << result.errors;
  }
}

TEST(Axis, TurnIsTheDesignsOwnTurn) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube([10, 3, 2]);");
  folder.write("b.scad", "rotate([0, 0, 90]) cube([10, 3, 2]);");
  folder.write("c.scad",
               "rotate([0, 0, -30]) rotate([-90, -90, 0]) "
               "cube([10, 3, 2]);");
  const auto slices = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"-o", "out.layers.json"});
    EXPECT_EQ(run(folder, words).status, 0);
    return support::read_file(folder.file("out.layers.json"));
  };
  EXPECT_EQ(slices({"a.scad", "--turn", "90"}), slices({"b.scad"}));
  EXPECT_EQ(slices({"a.scad", "--axis", "x", "--turn", "-30"}),
            slices({"c.scad"}));
  EXPECT_EQ(run(folder, {"a.scad", "--axis", "auto", "--turn", "9"}).status, 2);
}

TEST(Axis, OptionsThatMakeADesignFitAreNamed) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube([80, 140, 20]);");
  folder.write("b.scad", "cube([20, 150, 20]);");
  folder.write("c.scad", "cube([130, 20, 140]);");
  folder.write("d.scad", "cube([200, 150, 150]);");
  const auto fault = [&](std::vector<std::string> words) {
    words.insert(words.end(),
                 {"-o", "a.slc", "--printer", "elegoo-mars-3", "--layer", "1"});
    const auto result = run(folder, words);
    EXPECT_EQ(result.status, 1);
    return result.errors;
  };
  const auto follow = [&](std::vector<std::string> words) {
    words.insert(words.end(),
                 {"-o", "a.slc", "--printer", "elegoo-mars-3", "--layer", "1"});
    EXPECT_EQ(run(folder, words).status, 0);
  };
  EXPECT_TRUE(has(fault({"a.scad"}), "; with --axis z --turn 90 it fits\n"));
  follow({"a.scad", "--axis", "z", "--turn", "90"});
  EXPECT_TRUE(has(fault({"b.scad"}), "; with --axis y it fits\n"));
  follow({"b.scad", "--axis", "y"});
  EXPECT_TRUE(
      has(fault({"c.scad", "--axis", "y"}), "; with --axis z it fits\n"));
  follow({"c.scad", "--axis", "z"});
  EXPECT_TRUE(has(fault({"d.scad"}), "; it fits "));
  follow({"a.scad", "--axis", "auto"});
  follow({"b.scad", "--axis", "auto"});
}

TEST(Axis, AutoGivesTheLayersOfTheAxisItNames) {
  const TemporaryFolder folder;
  folder.write("a.scad",
               "rotate([0, 90, 0]) difference() { cylinder(r1 = 4, r2 = 3, "
               "h = 9.3, $fn = 50); translate([0, 0, 1]) cylinder(r = 2.6, "
               "h = 9); }");
  const auto result =
      run(folder, {"a.scad", "--axis", "auto", "-o", "auto.slc"});
  ASSERT_EQ(result.status, 0) << result.errors;
  EXPECT_TRUE(has(result.errors, "building direction x: the least cusp error"))
      << result.errors;
  ASSERT_EQ(run(folder, {"a.scad", "--axis", "x", "-o", "x.slc"}).status, 0);
  EXPECT_EQ(support::read_file(folder.file("auto.slc")),
            support::read_file(folder.file("x.slc")));
  const auto quiet = run(folder, {"a.scad", "--axis", "auto", "-q"});
  EXPECT_EQ(quiet.errors, "");
}

TEST(PlaceOnBed, TheLowestPointIsAtHeight0) {
  const TemporaryFolder folder;
  folder.write("a.scad", "translate([3, 4, 5.123]) cube(1);");
  const json layers = layers_of(folder, {"--place-on-bed", "--layer", "0.5"});
  ASSERT_EQ(layers.size(), 2U);
  EXPECT_NEAR(layers[0].at("bottom").get<double>(), 0, 1e-12);
  for (const auto& point : layers[0].at("contours")[0].at("points")) {
    EXPECT_GE(point[0].get<double>(), 3);
    EXPECT_GE(point[1].get<double>(), 4);
  }
}

}  // namespace
}  // namespace lamina::cli
