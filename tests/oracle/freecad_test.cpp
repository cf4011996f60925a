// Layers of FreeCAD files against sections that OpenCASCADE computes from the
// exact surfaces of FreeCAD's shapes.
//
// freecad_models.py builds a file for each feature. Its rows of
// docs/conformance-freecad.md are written to the build folder.
// freecad_mixtures.py builds files of objects that stand for others, at random:
// what FreeCAD shows of them is judged by its volume.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/arena.h"
#include "csg/import/freecad/freecad_file.h"
#include "tests/oracle/judge.h"
#include "tests/support/contour_checks.h"
#include "tests/support/design.h"
#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace lamina::oracle {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double kChordalError = 0.01;  // mm

plane::Contours contours_of(const json& loops) {
  plane::Contours contours;
  for (const json& loop : loops) {
    std::vector<Vec2> points;
    for (const json& point : loop) {
      points.emplace_back(point[0].get<double>(), point[1].get<double>());
    }
    contours.add_loop(points);
  }
  return contours;
}

// Whether all of the file is made by parameters.
bool is_by_parameter(const fs::path& file) {
  const std::string bytes = support::read_file(file.string());
  csg::FreecadOptions options;
  options.boundary_text = [](std::string_view, std::string_view) {
    return std::string();
  };
  Arena arena;
  const csg::FreecadModel model = csg::read_freecad(bytes, options, arena);
  return std::none_of(
      model.notes.begin(), model.notes.end(), [](const std::string& note) {
        return note.find("by its boundary") != std::string::npos;
      });
}

struct Row {
  std::string feature;
  bool is_by_parameter = true;
  double deviation = 0;  // area between the contours for their length [mm]
};

Row judge_model(const fs::path& file) {
  const json model = json::parse(
      support::read_file(fs::path(file).replace_extension("json").string()));
  Row row;
  row.feature = model["feature"];
  row.is_by_parameter = is_by_parameter(file);
  EXPECT_EQ(row.is_by_parameter, model["by"] == "parameter");
  const auto design = support::Design::from_text(
      fmt::format("import(\"{}\");", file.string()), kChordalError);
  std::vector<double> heights;
  for (const json& section : model["sections"]) {
    heights.push_back(section["height"]);
  }
  const auto layers = support::slice_heights(design.scene(), heights);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    SCOPED_TRACE(fmt::format("at z = {}", heights[i]));
    const ExactRegion expected =
        region_of_loops(contours_of(model["sections"][i]["loops"]));
    const Verdict verdict =
        judge(expected, layers[i].contours, {kChordalError + 1e-6, 2e-8});
    EXPECT_EQ(verdict.complaint, "");
    const Comparison& comparison = verdict.comparison;
    EXPECT_LE(std::abs(comparison.actual_area - comparison.expected_area),
              kChordalError * comparison.expected_perimeter + 1e-6);
    if (comparison.expected_perimeter > 0) {
      row.deviation =
          std::max(row.deviation,
                   comparison.difference_area / comparison.expected_perimeter);
    }
  }
  return row;
}

TEST(FreecadFiles, HaveTheSectionsOfTheirShapes) {
  const support::TemporaryFolder folder;
  const auto made = support::run_process(
      {"python3", LAMINA_ORACLE_SOURCES "/freecad_models.py", folder.path()});
  ASSERT_EQ(made.status, 0) << made.output << made.errors;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    if (entry.path().extension() == ".FCStd") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  ASSERT_GE(files.size(), 30U);
  std::ofstream table(LAMINA_FREECAD_TABLE);
  table << "| model | feature | by | deviation [µm] |\n|---|---|---|---|\n";
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.filename().string());
    const Row row = judge_model(file);
    table << fmt::format(
        "| `{}` | {} | {} | {:.1f} |\n", file.stem().string(), row.feature,
        row.is_by_parameter ? "parameter" : "boundary", row.deviation * 1000);
  }
}

// Of the layers of the file, each cut in its middle.
double volume_of(const fs::path& file) {
  const auto design = support::Design::from_text(
      fmt::format("import(\"{}\");", file.string()), kChordalError);
  slicer::Settings settings;
  settings.layer_thickness = 0.1;
  double volume = 0;
  for (const auto& layer : support::slice_layers(design.scene(), settings)) {
    volume += support::total_area(layer.contours) * settings.layer_thickness;
  }
  return volume;
}

TEST(FreecadFiles, HaveTheVolumeThatFreecadShows) {
  const support::TemporaryFolder folder;
  const auto made = support::run_process(
      {"python3", LAMINA_ORACLE_SOURCES "/freecad_mixtures.py", folder.path(),
       "100"});
  ASSERT_EQ(made.status, 0) << made.output << made.errors;
  const json volumes =
      json::parse(support::read_file(folder.path() + "/mixtures.json"));
  ASSERT_EQ(volumes.size(), 100U);
  for (const auto& [name, shown] : volumes.items()) {
    const fs::path file = fs::path(folder.path()) / (name + ".FCStd");
    EXPECT_NEAR(volume_of(file), shown.get<double>(),
                0.005 * shown.get<double>())
        << name;
  }
}

}  // namespace
}  // namespace lamina::oracle
