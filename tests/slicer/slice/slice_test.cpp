// The pipeline: every layer once, in order, the same however many threads.

#include "slicer/slice/slice.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "base/diagnostic.h"
#include "tests/support/contour_checks.h"
#include "tests/support/leaf_scenes.h"

namespace lamina::slicer {
namespace {

struct LayerList : LayerSink {
  void take(const Layer& layer) override { layers.push_back(layer); }
  std::vector<Layer> layers;
};

std::vector<Layer> slice_to_list(const csg::Scene& scene,
                                 const Settings& settings) {
  LayerList list;
  Diagnostics diagnostics;
  const SliceReport report =
      slice(scene, plan_layers(scene, settings), settings, list, diagnostics);
  EXPECT_EQ(report.layers, list.layers.size());
  return std::move(list.layers);
}

csg::Scene drilled_ball() {
  csg::Scene scene = support::scene_of(plane::BooleanOp::kDifference);
  scene.leaves.push_back(support::mesh_leaf(support::sphere_mesh(60, 3)));
  scene.leaves.push_back(
      support::mesh_leaf(support::prism_mesh(40, 0.8, -5, 5)));
  support::place_leaf(scene, 0, support::shift_by({0.1, 0.2, 0.3}));
  support::place_leaf(scene, 1, support::turn_about({1, 2, 0}, 0.7));
  scene.box = scene.instances[0].box;
  return scene;
}

TEST(Slice, LayersComeInOrderWithoutGapsOrRepeats) {
  const csg::Scene scene = drilled_ball();
  for (const double thickness : {0.003, 0.05, 0.3, 1.7}) {
    for (const ContourMode mode :
         {ContourMode::kFaithful, ContourMode::kPaper}) {
      Settings settings;
      settings.layer_thickness = thickness;
      settings.contour = mode;
      settings.ray_pitch = 0.2;
      const auto layers = slice_to_list(scene, settings);
      ASSERT_FALSE(layers.empty());
      for (std::size_t i = 0; i < layers.size(); ++i) {
        EXPECT_NEAR(layers[i].bottom,
                    layers[0].bottom + static_cast<double>(i) * thickness,
                    1e-9);
        EXPECT_NEAR(layers[i].top - layers[i].bottom, thickness, 1e-9);
        EXPECT_NEAR(layers[i].section_z, (layers[i].bottom + layers[i].top) / 2,
                    1e-9);
      }
    }
  }
}

TEST(Slice, AnyNumberOfThreadsGivesTheSameLayers) {
  const csg::Scene scene = drilled_ball();
  for (const ContourMode mode : {ContourMode::kFaithful, ContourMode::kPaper}) {
    Settings settings;
    settings.layer_thickness = 0.01;
    settings.contour = mode;
    settings.threads = 1;
    const auto one = slice_to_list(scene, settings);
    settings.threads = 5;
    const auto five = slice_to_list(scene, settings);
    ASSERT_EQ(one.size(), five.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(one[i].contours.points, five[i].contours.points);
      EXPECT_EQ(one[i].contours.ends, five[i].contours.ends);
    }
  }
}

TEST(Slice, HeightsGiveALayerEachInThatOrder) {
  const csg::Scene scene = drilled_ball();
  Settings settings;
  settings.heights = {-100, -0.5, 0, 0.25, 7};
  const auto layers = slice_to_list(scene, settings);
  ASSERT_EQ(layers.size(), 5U);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    EXPECT_EQ(layers[i].section_z, settings.heights[i]);
    EXPECT_EQ(layers[i].bottom, settings.heights[i]);
    EXPECT_EQ(layers[i].top, settings.heights[i]);
  }
  EXPECT_TRUE(layers.front().contours.is_empty());
  EXPECT_FALSE(layers[2].contours.is_empty());
  EXPECT_TRUE(layers.back().contours.is_empty());
}

TEST(Slice, SimplificationStaysWithinTheTolerance) {
  const csg::Scene scene = drilled_ball();
  Settings settings;
  settings.layer_thickness = 0.05;
  settings.tolerance = 0;
  const auto exact = slice_to_list(scene, settings);
  settings.tolerance = 0.01;
  const auto simple = slice_to_list(scene, settings);
  ASSERT_EQ(exact.size(), simple.size());
  for (std::size_t i = 0; i < exact.size(); ++i) {
    EXPECT_TRUE(support::are_sound(simple[i].contours));
    EXPECT_LE(simple[i].contours.points.size(),
              exact[i].contours.points.size());
    for (const Vec2& point : exact[i].contours.points) {
      EXPECT_LE(support::distance_to_edges(simple[i].contours, point), 0.01);
    }
  }
}

TEST(Slice, NothingToSliceIsAnError) {
  csg::Scene empty;
  empty.program.emplace_back();
  EXPECT_THROW(plan_layers(empty, {}), GeometryError);
}

TEST(Slice, ThePapersPitchDefaultsToTheLayersThickness) {
  const csg::Scene scene = drilled_ball();
  Settings settings;
  settings.layer_thickness = 0.2;
  settings.contour = ContourMode::kPaper;
  const auto counts_for = [&](double pitch) {
    settings.ray_pitch = pitch;
    LayerList list;
    Diagnostics diagnostics;
    return slice(scene, plan_layers(scene, settings), settings, list,
                 diagnostics)
        .paper;
  };
  const ldni::PaperCounts open = counts_for(0);
  const ldni::PaperCounts equal = counts_for(settings.layer_thickness);
  EXPECT_GT(open.pixels(), 0U);
  EXPECT_EQ(open.pixels(), equal.pixels());
  EXPECT_EQ(open.samples, equal.samples);
  EXPECT_EQ(open.intervals, equal.intervals);
  EXPECT_NE(open.pixels(), counts_for(0.1).pixels());
}

TEST(SliceOutline, CountsTheHolesAndTheArea) {
  plane::Region outline;
  outline.contours = {{{0, 0}, {4, 0}, {4, 3}, {0, 3}},
                      {{1, 1}, {1, 2}, {2, 2}, {2, 1}},
                      {{3, 1}, {3, 2}, {3.5, 1}}};
  LayerList list;
  Diagnostics diagnostics;
  const SliceReport report = slice_outline(outline, {}, list, diagnostics);
  EXPECT_EQ(report.layers, 1U);
  EXPECT_EQ(report.loops, 3U);
  EXPECT_EQ(report.holes, 2U);
  EXPECT_EQ(report.points, 11U);
  EXPECT_DOUBLE_EQ(report.greatest_area, 12 - 1 - 0.25);
}

// Lowering repairs every mesh, so this is a fault of ours, which must not pass
// in silence.
TEST(Slice, WarnsWhereALeafIsOpen) {
  csg::Scene scene = drilled_ball();
  auto& triangles = scene.leaves[0].meshes[0].triangles;
  triangles.erase(triangles.begin() + 1000);
  LayerList list;
  Diagnostics diagnostics;
  const SliceReport report =
      slice(scene, plan_layers(scene, {}), {}, list, diagnostics);
  EXPECT_GT(report.open_paths, 0U);
  ASSERT_EQ(diagnostics.all().size(), 1U);
  EXPECT_EQ(diagnostics.all()[0].severity, Severity::kWarning);
}

}  // namespace
}  // namespace lamina::slicer
