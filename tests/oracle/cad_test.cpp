// Layers of parts that FreeCAD builds, exports and cuts: it computes sections
// from the exact surfaces (freecad_parts.py, freecad_sections.py), and lamina
// cuts the meshes that it makes of the files.

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "plane/region/boolean.h"
#include "plane/region/region.h"
#include "tests/oracle/exact_region.h"
#include "tests/oracle/judge.h"
#include "tests/support/design.h"

namespace lamina::oracle {
namespace {

namespace fs = std::filesystem;

const fs::path kParts = LAMINA_FREECAD_PARTS;

struct Section {
  double height = 0;
  double area = 0;
  plane::Region region;
};

plane::Region to_region(const nlohmann::json& loops) {
  std::vector<plane::Contour> contours;
  for (const auto& loop : loops) {
    plane::Contour& contour = contours.emplace_back();
    for (const auto& point : loop) contour.emplace_back(point[0], point[1]);
  }
  return plane::from_contours(contours);
}

std::vector<Section> sections_of(const std::string& name) {
  std::ifstream file(kParts / (name + ".json"));
  std::vector<Section> sections;
  const nlohmann::json all = nlohmann::json::parse(file);
  for (const auto& layer : all["layers"]) {
    std::vector<plane::Region> solids;
    for (const auto& loops : layer["solids"]) {
      solids.push_back(to_region(loops));
    }
    sections.push_back(
        {layer["height"], layer["area"],
         solids.empty() ? plane::Region() : plane::unite(solids)});
  }
  return sections;
}

// Cuts the file where FreeCAD cut its part, and judges all layers.
void expect_sections(const std::string& file, const std::string& name,
                     double chordal_error) {
  const std::vector<Section> sections = sections_of(name);
  ASSERT_FALSE(sections.empty());
  std::vector<double> heights;
  for (const Section& section : sections) heights.push_back(section.height);
  const auto design = support::Design::from_text(
      fmt::format("import(\"{}\");", (kParts / file).string()), chordal_error);
  const auto layers = support::slice_heights(design.scene(), heights);
  ASSERT_EQ(layers.size(), heights.size());
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const Verdict verdict =
        judge(region_of_loops(plane::to_contours(sections[i].region)),
              layers[i].contours, {chordal_error, 2 * chordal_error});
    EXPECT_EQ(verdict.complaint, "") << file << " at " << heights[i];
    const Comparison& compared = verdict.comparison;
    EXPECT_NEAR(compared.actual_area, sections[i].area,
                chordal_error * compared.expected_perimeter)
        << file << " at " << heights[i];
  }
}

const std::vector<std::string> kNames = {"cylinder",       "leaning_cylinder",
                                         "cone",           "whole_cone",
                                         "ball",           "ring",
                                         "leaning_ring",   "ellipsoid",
                                         "filleted_block", "chamfered_block",
                                         "drilled_block",  "hollow_ball",
                                         "loft",           "smooth_loft",
                                         "vase",           "part_of_a_turn",
                                         "pipe",           "spline_plate",
                                         "shelled_block",  "mirrored_wedge",
                                         "crossed_pipes",  "tiny_gem",
                                         "knob",           "assembly"};

class FreeCadPart : public ::testing::TestWithParam<std::string> {};

TEST_P(FreeCadPart, HasItsSectionsFromStep) {
  expect_sections(GetParam() + ".step", GetParam(), 0.01);
}

TEST_P(FreeCadPart, HasItsSectionsFromIges) {
  expect_sections(GetParam() + ".iges", GetParam(), 0.02);
}

TEST_P(FreeCadPart, HasItsSectionsFromBrep) {
  expect_sections(GetParam() + ".brep", GetParam(), 0.05);
  expect_sections(GetParam() + ".brp", GetParam(), 0.002);
}

INSTANTIATE_TEST_SUITE_P(Oracle, FreeCadPart, ::testing::ValuesIn(kNames),
                         [](const auto& part) { return part.param; });

TEST(FreeCadParts, CountInTheUnitOfTheFile) {
  expect_sections("drilled_block_in_inch.step", "drilled_block_in_inch", 0.1);
  expect_sections("drilled_block_in_metre.step", "drilled_block_in_metre", 5);
}

TEST(FreeCadParts, AreAllJudged) {
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(kParts)) {
    if (entry.path().extension() == ".brp") ++count;
  }
  EXPECT_EQ(count, kNames.size());
}

}  // namespace
}  // namespace lamina::oracle
