// Simplification of layers of whole designs: the laws hold, and few vertices
// stay.

#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/slicer/contour/simplify_laws.h"
#include "tests/support/design.h"
#include "tests/support/random_scenes.h"

namespace lamina::slicer {
namespace {

const std::vector<double> kTolerances = {0.001, 0.01, 0.05, 0.2};

// Returns how many vertices it saw.
std::size_t expect_lawful_layers(const csg::Scene& scene, int count,
                                 const std::string& what) {
  std::vector<double> heights;
  heights.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    heights.push_back(scene.box.low.z + (scene.box.high.z - scene.box.low.z) *
                                            (i + 0.37) / count);
  }
  std::size_t vertices = 0;
  for (const Layer& layer : support::slice_heights(scene, heights)) {
    vertices += layer.contours.points.size();
    for (const double tolerance : kTolerances) {
      expect_lawful(
          layer.contours, tolerance,
          fmt::format("{}, z = {}, {}", what, layer.section_z, tolerance));
    }
  }
  return vertices;
}

// A benchmark's scene with another value of its parameter.
support::Design scene_with(const std::string& name,
                           const std::string& definition) {
  return support::Design::from_text(fmt::format(
      "include <{}/{}.scad>\n{};", LAMINA_BENCH_SCENES, name, definition));
}

TEST(SimplifyScenes, ARing) {
  EXPECT_GT(expect_lawful_layers(scene_with("ring55", "k = 165").scene(), 12,
                                 "ring55"),
            5000U);
}

TEST(SimplifyScenes, AVessel) {
  EXPECT_GT(expect_lawful_layers(scene_with("submarine74", "k = 126").scene(),
                                 12, "submarine74"),
            5000U);
}

TEST(SimplifyScenes, ALattice) {
  EXPECT_GT(expect_lawful_layers(scene_with("lattice", "N = 20").scene(), 12,
                                 "lattice"),
            5000U);
}

TEST(SimplifyScenes, RandomScenesOfEveryStyle) {
  std::size_t vertices = 0;
  for (int style = 0; style < support::kSceneStyleCount; ++style) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
      const csg::Scene scene = support::random_scene(
          seed, static_cast<support::SceneStyle>(style), 20);
      if (scene.box.is_empty()) continue;
      vertices += expect_lawful_layers(
          scene, 4, fmt::format("style {}, seed {}", style, seed));
    }
  }
  EXPECT_GT(vertices, 20'000U);
}

}  // namespace
}  // namespace lamina::slicer
