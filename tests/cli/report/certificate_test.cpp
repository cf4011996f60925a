// What a run reports about its own layers: how far they can be from the design,
// and what in them is thin.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "slicer/formats/slc_reader.h"
#include "tests/cli/lamina.h"
#include "tests/support/contour_checks.h"
#include "tests/support/text.h"

namespace lamina::cli {
namespace {

using nlohmann::json;
using support::has;
using support::read_file;
using support::TemporaryFolder;

json read_report(const TemporaryFolder& folder) {
  return json::parse(read_file(folder.file("r.json")));
}

const char* const kHead =
    "module prong(d) {\n"
    "  cylinder(d = d, h = 2, $fn = 16);\n"
    "}\n"
    "cylinder(r = 3, h = 0.5, $fn = 60);\n"
    "for (a = [0, 120, 240]) rotate(a) translate([2, 0, 0]) prong(0.15);\n"
    "translate([0, 0, 0.5]) { cube([1, 1, 1]); translate([-0.95, 0, 0]) "
    "cube([0.9, 1, 1]); }\n";

TEST(Certificate, ThinFeaturesAreToldWithTheLineThatMadeThem) {
  const TemporaryFolder folder;
  folder.write("a.scad", kHead);
  const auto result = run(folder, {"a.scad", "--min-feature", "0.2"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.output, "");
  EXPECT_TRUE(has(result.errors, "thinner than 0.2 mm: 3 walls, 1 gap\n"))
      << result.errors;
  EXPECT_TRUE(has(result.errors, "3 walls")) << result.errors;
  EXPECT_TRUE(has(result.errors, "  a.scad:2:3 from a.scad:5:56\n"))
      << result.errors;
  EXPECT_TRUE(has(result.errors, "0.0500")) << result.errors;
  EXPECT_TRUE(has(result.errors, "  a.scad:6:26, a.scad:6:68\n"))
      << result.errors;
  EXPECT_EQ(run(folder, {"a.scad", "--min-feature", "0.2", "-q"}).errors, "");
  EXPECT_TRUE(has(run(folder, {"a.scad", "--min-feature", "0.04"}).errors,
                  "thinner than 0.04 mm: 0 walls, 0 gaps\n"));
  EXPECT_FALSE(has(run(folder, {"a.scad"}).errors, "thinner"));
}

TEST(Certificate, TheReportHoldsThinFeatures) {
  const TemporaryFolder folder;
  folder.write("a.scad", kHead);
  ASSERT_EQ(
      run(folder, {"a.scad", "--min-feature", "0.2", "--report", "r.json"})
          .status,
      0);
  const json report = read_report(folder);
  EXPECT_EQ(report.at("min_feature_mm"), 0.2);
  EXPECT_GT(report.at("feature_seconds").get<double>(), 0);
  const json& features = report.at("features");
  ASSERT_EQ(features.size(), 4U);
  std::size_t walls = 0;
  for (const json& feature : features) {
    EXPECT_EQ(feature.at("first_layer"), 11);
    EXPECT_FALSE(feature.at("is_low").get<bool>());
    if (feature.at("kind") == "wall") {
      ++walls;
      EXPECT_NEAR(feature.at("width_mm").get<double>(),
                  0.15 * std::cos(std::acos(-1) / 16), 1e-9);
      EXPECT_EQ(feature.at("last_layer"), 40);
      EXPECT_NEAR(feature.at("top").get<double>(), 2, 1e-9);
      EXPECT_NEAR(std::hypot(feature.at("x").get<double>(),
                             feature.at("y").get<double>()),
                  2, 1e-7);
      ASSERT_EQ(feature.at("made_by").size(), 1U);
      const json& maker = feature.at("made_by")[0];
      EXPECT_EQ(maker.at("place"), "a.scad:2:3");
      EXPECT_EQ(
          maker.at("called_by"),
          json::parse(R"([{"module": "prong", "place": "a.scad:5:56"}])"));
    } else {
      EXPECT_NEAR(feature.at("width_mm").get<double>(), 0.05, 1e-9);
      EXPECT_EQ(feature.at("made_by").size(), 2U);
      EXPECT_NEAR(feature.at("x").get<double>(), -0.025, 1e-9);
    }
  }
  EXPECT_EQ(walls, 3U);
}

TEST(Certificate, AReportWithoutMinFeatureHasNoFeatures) {
  const TemporaryFolder folder;
  folder.write("a.scad", "cube([4, 5, 2]); echo(x);");
  ASSERT_EQ(run(folder, {"a.scad", "--report", "r.json"}).status, 0);
  const json report = read_report(folder);
  EXPECT_FALSE(report.contains("features"));
  EXPECT_EQ(report.at("warnings"), 1);
  EXPECT_NEAR(report.at("volume_mm3").get<double>(), 40, 1e-9);
  EXPECT_NEAR(report.at("greatest_area_mm2").get<double>(), 20, 1e-9);
  EXPECT_EQ(report.at("holes"), 0);
  for (const char* const key : {"open_paths", "capped_clusters",
                                "repaired_clusters", "snapped_layers"}) {
    EXPECT_EQ(report.at(key), 0);
  }
}

TEST(Certificate, OutlinesHaveThinFeaturesToo) {
  const TemporaryFolder folder;
  folder.write("a.scad", "square([5, 0.1]);");
  const auto result =
      run(folder, {"a.scad", "-o", "a.layers.json", "--min-feature", "0.2"});
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(has(result.errors, "1 wall, 0 gaps")) << result.errors;
}

TEST(Certificate, TheBoundIsTheSumOfItsParts) {
  const TemporaryFolder folder;
  folder.write("a.scad", "sphere(3);");
  const auto bound = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"a.scad", "--report", "r.json"});
    EXPECT_EQ(run(folder, options).status, 0);
    return read_report(folder).at("deviation_mm");
  };
  const json plain = bound({});
  EXPECT_EQ(plain.at("simplification"), 0.001);
  EXPECT_TRUE(plain.at("from_curves").is_null());
  EXPECT_TRUE(plain.at("facets").is_null());
  EXPECT_GT(plain.at("rounding").get<double>(), 0);
  double sum = 0;
  for (const char* const part :
       {"ties", "clusters", "compensation", "simplification", "rounding"}) {
    sum += plain.at(part).get<double>();
  }
  EXPECT_DOUBLE_EQ(plain.at("from_section").get<double>(), sum);

  const json fine = bound(
      {"--tolerance", "0", "--chordal-error", "0.002", "-o", "a.layers.json"});
  EXPECT_EQ(fine.at("rounding"), 0);
  EXPECT_LT(fine.at("from_section").get<double>(), 2e-6);
  EXPECT_NEAR(fine.at("from_curves").get<double>(), 0.002, 2e-6);
  EXPECT_EQ(plain.at("compensation"), 0);
  EXPECT_EQ(bound({"--compensate", "0.1"}).at("compensation"), 1e-4);
  // Nothing is promised of the paper's contours.
  EXPECT_TRUE(bound({"--contour", "paper", "--ray", "0.1"}).is_null());
}

TEST(Certificate, FilesKeepTheBound) {
  const TemporaryFolder folder;
  folder.write("a.scad",
               "translate([120, -70, 0]) difference() { sphere(3, $fn = 90);"
               "rotate([20, 30, 0]) cylinder(r = 1, h = 9, center = true,"
               "$fn = 70); }");
  ASSERT_EQ(
      run(folder, {"a.scad", "--tolerance", "0", "-o", "a.layers.json"}).status,
      0);
  const json exact = json::parse(read_file(folder.file("a.layers.json")));
  for (const char* const tolerance : {"0", "0.001", "0.02"}) {
    ASSERT_EQ(
        run(folder, {"a.scad", "--tolerance", tolerance, "--report", "r.json"})
            .status,
        0);
    const double bound =
        read_report(folder).at("deviation_mm").at("from_section");
    slicer::SlcReader reader(folder.file("a.slc"));
    slicer::SlcLayer layer;
    for (const json& json_layer : exact.at("layers")) {
      ASSERT_TRUE(reader.read_layer(layer));
      plane::Contours expected;
      for (const json& contour : json_layer.at("contours")) {
        std::vector<Vec2> points;
        for (const json& point : contour.at("points")) {
          points.emplace_back(point[0].get<double>(), point[1].get<double>());
        }
        support::add_loop(expected, points);
      }
      ASSERT_LE(support::greatest_distance(expected,
                                           slicer::to_layer(layer).contours),
                bound);
    }
  }
}

TEST(Certificate, InspectTellsOfThinFeaturesAndRounding) {
  const TemporaryFolder folder;
  folder.write("a.scad", kHead);
  ASSERT_EQ(run(folder, {"a.scad"}).status, 0);
  const auto result = run(folder, {"inspect", "a.slc", "--min-feature", "0.2"});
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(has(result.output, "thinner than 0.2 mm: 3 walls, 1 gap\n"))
      << result.output;
  EXPECT_TRUE(has(result.output, "0.0500")) << result.output;
  // Half a step of the numbers between 2 and 4, in x and in y.
  EXPECT_TRUE(has(result.output, "rounding  at most 1.7e-07 mm"))
      << result.output;
  EXPECT_TRUE(has(result.output, "deviation at most 0.00100117 mm"))
      << result.output;
  EXPECT_FALSE(has(run(folder, {"inspect", "a.slc"}).output, "thinner"));
}

}  // namespace
}  // namespace lamina::cli
