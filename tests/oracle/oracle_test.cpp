// Exact sections and openscad judge every design in tests/oracle/scenes, at ten
// generic heights. Each case leaves one row for the table that `oracle_table`
// prints.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/oracle/exact_region.h"
#include "tests/oracle/judge.h"
#include "tests/oracle/nef_solid.h"
#include "tests/oracle/openscad.h"
#include "tests/oracle/polygon_sets.h"
#include "tests/oracle/world_scene.h"
#include "tests/support/contour_checks.h"
#include "tests/support/design.h"

namespace lamina::oracle {
namespace {

namespace fs = std::filesystem;

const fs::path kScenes = LAMINA_ORACLE_SCENES;
const fs::path kRows = LAMINA_ORACLE_ROWS;

constexpr std::size_t kHeights = 10;

// OpenSCAD's own grid of 2D designs, 2^-16 mm, and a bit [mm].
constexpr double kOpenScadDistance = 2e-5;

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kScenes)) {
    if (entry.path().extension() == ".scad") {
      names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

fs::path scene_path(const std::string& name) {
  return kScenes / (name + ".scad");
}

// Largest figures over all heights of a scene.
struct Row {
  std::size_t regions = 0;
  std::size_t holes = 0;
  double distance = 0;  // symmetric difference / perimeter [mm]
  std::size_t settled = 0;

  void add(const Verdict& verdict) {
    const Comparison& comparison = verdict.comparison;
    regions += verdict.counts.regions;
    holes += verdict.counts.holes;
    if (comparison.difference_area > 0) {
      distance = std::max(
          distance, comparison.difference_area / comparison.expected_perimeter);
    }
    settled += verdict.was_settled ? 1 : 0;
  }

  void write(const std::string& scene, const std::string& judge, double allowed,
             bool passed) const {
    fs::create_directories(kRows);
    std::ofstream(kRows / (scene + "." + judge)) << fmt::format(
        "{} {} {} {:.2e} {:.2e} {} {}\n", kHeights, regions, holes, distance,
        allowed, settled, passed ? "equal" : "DIFFERS");
  }
};

class Scene : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    heights_ = generic_heights(world_, design_.scene().box.low.z,
                               design_.scene().box.high.z, kHeights);
  }

  support::Design design_ = support::Design::from_file(scene_path(GetParam()));
  WorldScene world_ = world_scene(design_.scene());
  std::vector<double> heights_;
};

TEST_P(Scene, EqualsTheExactSections) {
  std::vector<ExactRegion> sections;
  sections.reserve(heights_.size());
  for (const double z : heights_) sections.push_back(exact_section(world_, z));

  Row worst;
  for (const double pitch : {0.02, 0.5, 0.0}) {
    const auto layers =
        support::slice_heights(design_.scene(), heights_, pitch);
    ASSERT_EQ(layers.size(), heights_.size());
    Row row;
    for (std::size_t i = 0; i < layers.size(); ++i) {
      SCOPED_TRACE(fmt::format("z = {}, pitch {}", heights_[i], pitch));
      EXPECT_TRUE(support::are_sound(layers[i].contours));
      const Verdict verdict =
          judge(sections[i], layers[i].contours, kExactAllowance);
      EXPECT_EQ(verdict.complaint, "");
      row.add(verdict);
    }
    row.distance = std::max(row.distance, worst.distance);
    worst = row;
  }
  worst.write(GetParam(), "exact", kExactAllowance.distance, !HasFailure());
}

TEST_P(Scene, EqualsWhatOpenScadRenders) {
  const csg::Mesh mesh = render_with_openscad(scene_path(GetParam()));
  const double distance = kOpenScadDistance + float32_spacing(mesh);
  const auto layers = support::slice_heights(design_.scene(), heights_);
  ASSERT_EQ(layers.size(), heights_.size());

  Row row;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    SCOPED_TRACE(fmt::format("z = {}", heights_[i]));
    const Verdict verdict = judge(exact_section(mesh, heights_[i], distance),
                                  layers[i].contours, {distance, distance});
    EXPECT_EQ(verdict.complaint, "");
    row.add(verdict);
  }
  row.write(GetParam(), "openscad", distance, !HasFailure());
}

// Judges on each other, without lamina's contours: two of the heights, for
// sets are slow.
TEST_P(Scene, HasExactSectionsThatPolygonSetsConfirm) {
  for (const std::size_t i : {std::size_t{3}, std::size_t{6}}) {
    const double z = heights_[i];
    const ExactRegion section = exact_section(world_, z);
    const SetSection by_sets = section_by_sets(world_, z);
    EXPECT_EQ(by_sets.area, exact_area(section)) << "z = " << z;
    // Sets join what touches in a point.
    EXPECT_LE(by_sets.counts.regions, count_regions(section).regions);
    EXPECT_LE(by_sets.counts.holes, count_regions(section).holes);
  }
}

TEST_P(Scene, HasExactSectionsThatOpenScadConfirms) {
  const csg::Mesh mesh = render_with_openscad(scene_path(GetParam()));
  const double distance = kOpenScadDistance + float32_spacing(mesh);
  for (const double z : heights_) {
    const Verdict verdict =
        judge(exact_section(mesh, z, distance), exact_section(world_, z),
              {distance, distance});
    EXPECT_EQ(verdict.complaint, "") << "z = " << z;
  }
}

INSTANTIATE_TEST_SUITE_P(Oracle, Scene, ::testing::ValuesIn(scene_names()),
                         [](const auto& scene) { return scene.param; });

TEST(Scenes, AreAtLeastTwentyFive) { EXPECT_GE(scene_names().size(), 25U); }

// The designs of bench/ and examples/, what goldsmiths make and some more,
// at the default values of their parameters.
class WholeDesign : public ::testing::TestWithParam<std::string> {};

TEST_P(WholeDesign, EqualsTheExactSections) {
  constexpr std::size_t kManyHeights = 20;
  const support::Design design =
      support::Design::from_file(fs::path(LAMINA_SOURCES) / GetParam());
  const csg::Scene& scene = design.scene();
  const WorldScene world = world_scene(scene);
  const auto heights =
      generic_heights(world, scene.box.low.z, scene.box.high.z, kManyHeights);
  const auto layers = support::slice_heights(scene, heights);
  ASSERT_EQ(layers.size(), heights.size());
  for (std::size_t i = 0; i < layers.size(); ++i) {
    SCOPED_TRACE(fmt::format("z = {}", heights[i]));
    EXPECT_TRUE(support::are_sound(layers[i].contours));
    const Verdict verdict = judge(exact_section(world, heights[i]),
                                  layers[i].contours, kExactAllowance);
    EXPECT_EQ(verdict.complaint, "");
  }
}

INSTANTIATE_TEST_SUITE_P(
    Oracle, WholeDesign,
    ::testing::Values("bench/scenes/ring55.scad",
                      "bench/scenes/submarine74.scad",
                      "bench/scenes/lattice.scad", "bench/scenes/thin_gap.scad",
                      "bench/scenes/ring_mesh.scad", "examples/braid.scad",
                      "examples/eternity.scad", "examples/filigree.scad",
                      "examples/hoop.scad", "examples/medal.scad",
                      "examples/pendant.scad", "examples/signet.scad",
                      "examples/solitaire.scad"),
    [](const auto& design) { return fs::path(design.param).stem().string(); });

class NefScene : public Scene {};

TEST_P(NefScene, EqualsTheSectionsOfANefPolyhedron) {
  const csg::Mesh boundary = nef_boundary(world_);
  const auto layers = support::slice_heights(design_.scene(), heights_);
  ASSERT_EQ(layers.size(), heights_.size());
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const Verdict verdict = judge(exact_section(boundary, heights_[i], 1e-9),
                                  layers[i].contours, kExactAllowance);
    EXPECT_EQ(verdict.complaint, "") << "z = " << heights_[i];
  }
}

INSTANTIATE_TEST_SUITE_P(Oracle, NefScene,
                         ::testing::Values("coplanar_difference", "mirrored",
                                           "intersection"),
                         [](const auto& scene) { return scene.param; });

}  // namespace
}  // namespace lamina::oracle
