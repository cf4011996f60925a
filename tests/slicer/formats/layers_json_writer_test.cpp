#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/slicer/formats/writing.h"
#include "tests/support/contour_checks.h"

namespace lamina::slicer {
namespace {

std::string write_json(const std::vector<Layer>& layers) {
  return written(layers, {.format = OutputFormat::kLayersJson});
}

TEST(LayersJsonWriter, AnotherJsonLibraryReadsEveryDigitBack) {
  const double third = 1.0 / 3;
  Layer first;
  first.bottom = -0.1;
  first.section_z = -0.075;
  first.top = -0.05;
  support::add_loop(first.contours, {{0, 0}, {third, 1e-300}, {1e22, 0.1}});
  support::add_loop(first.contours, {{1, 1}, {1, 2}, {2, 2}});
  Layer empty;

  const auto json = nlohmann::json::parse(write_json({first, empty}));
  EXPECT_EQ(json.at("units"), "mm");
  ASSERT_EQ(json.at("layers").size(), 2U);
  const auto& layer = json["layers"][0];
  EXPECT_EQ(layer.at("z").get<double>(), -0.075);
  EXPECT_EQ(layer.at("bottom").get<double>(), -0.1);
  EXPECT_EQ(layer.at("top").get<double>(), -0.05);
  ASSERT_EQ(layer.at("contours").size(), 2U);
  EXPECT_FALSE(layer["contours"][0].at("hole").get<bool>());
  EXPECT_TRUE(layer["contours"][1].at("hole").get<bool>());
  const auto& points = layer["contours"][0].at("points");
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[1][0].get<double>(), third);
  EXPECT_EQ(points[1][1].get<double>(), 1e-300);
  EXPECT_EQ(points[2][0].get<double>(), 1e22);
  EXPECT_TRUE(json["layers"][1].at("contours").empty());
}

TEST(LayersJsonWriter, NoLayersAreAnEmptyList) {
  const auto json = nlohmann::json::parse(write_json({}));
  EXPECT_TRUE(json.at("layers").empty());
}

}  // namespace
}  // namespace lamina::slicer
