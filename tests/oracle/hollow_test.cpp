// Walls of hollow parts, measured by CGAL from surfaces that openscad renders.

#include "slicer/hollow/hollow.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "base/diagnostic.h"
#include "csg/minkowski/shell.h"
#include "tests/oracle/openscad.h"
#include "tests/oracle/pieces.h"
#include "tests/oracle/surface_distance.h"
#include "tests/support/design.h"
#include "tests/support/temporary_folder.h"

namespace lamina::oracle {
namespace {

// Heights of sections; with steps along them that makes some 10⁵ places.
constexpr int kSections = 60;
constexpr double kStep = 0.04;

// Places along all contours, no farther apart than kStep.
std::vector<Vec3> places_on(const std::vector<slicer::Layer>& layers) {
  std::vector<Vec3> places;
  for (const slicer::Layer& layer : layers) {
    for (std::size_t i = 0; i < layer.contours.loop_count(); ++i) {
      const auto loop = layer.contours.loop(i);
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vec2 from = loop[k];
        const Vec2 to = loop[(k + 1) % loop.size()];
        const int parts = 1 + static_cast<int>(glm::length(to - from) / kStep);
        for (int part = 0; part < parts; ++part) {
          places.emplace_back(from + (to - from) * (double(part) / parts),
                              layer.section_z);
        }
      }
    }
  }
  return places;
}

class HollowWalls : public testing::TestWithParam<std::tuple<int, double>> {
 protected:
  const char* text() const { return kPieces[std::get<0>(GetParam())]; }

  const double wall_ = std::get<1>(GetParam());
  const support::TemporaryFolder folder_;
  const csg::Mesh surface_ =
      render_with_openscad(folder_.write("a.scad", text()));
  const support::Design design_ = support::Design::from_text(text());
};

TEST_P(HollowWalls, AreAsThickAsAskedFor) {
  csg::Scene scene = design_.scene();
  Diagnostics diagnostics;
  const auto report = slicer::hollow_out(
      scene, {.wall = wall_, .has_drains = false}, {}, diagnostics);
  ASSERT_GE(report.cavities, 1U);
  std::vector<double> heights;
  for (int i = 0; i < kSections; ++i) {
    heights.push_back(scene.box.low.z +
                      (i + 0.37) / kSections * scene.box.size().z);
  }
  const std::vector<double> distances = distances_from(
      surface_, places_on(support::slice_heights(scene, heights)));
  // openscad's STL rounds to six digits.
  constexpr double kRounding = 1e-4;
  std::size_t inside = 0;
  double least = 1e9;
  double greatest = 0;
  for (const double distance : distances) {
    if (distance < kRounding) continue;
    ++inside;
    least = std::min(least, distance);
    greatest = std::max(greatest, distance);
  }
  RecordProperty("places", std::to_string(inside));
  RecordProperty("least", std::to_string(least));
  RecordProperty("greatest", std::to_string(greatest));
  EXPECT_GT(inside, 10000U);
  EXPECT_GE(least, wall_ - kRounding);
  EXPECT_LE(greatest, wall_ * (1 + csg::kShellExcess) + kRounding);
}

// In the layers of the run: between them the cavities are prisms.
TEST_P(HollowWalls, AreNoThinnerWhereNarrowPlacesStaySolid) {
  csg::Scene scene = design_.scene();
  const double low = scene.box.low.z;
  const double height = scene.box.size().z;
  constexpr double kLayer = 0.1;
  slicer::Settings settings;
  settings.layer_thickness = kLayer;
  Diagnostics diagnostics;
  slicer::hollow_out(scene,
                     {.wall = wall_, .closing = 0.5, .has_drains = false},
                     settings, diagnostics);
  std::vector<double> heights;
  for (int k = 0; (k + 1) * kLayer < height; k += 3) {
    heights.push_back(low + (k + 0.5) * kLayer);
  }
  double least = 1e9;
  for (const double distance : distances_from(
           surface_, places_on(support::slice_heights(scene, heights)))) {
    if (distance > 1e-4) least = std::min(least, distance);
  }
  // Layers were simplified before they were dilated.
  EXPECT_GE(least, wall_ - 0.0021);
}

INSTANTIATE_TEST_SUITE_P(
    Pieces, HollowWalls,
    testing::Combine(testing::Range(0, static_cast<int>(std::size(kPieces))),
                     testing::Values(0.4, 0.8, 2.0)));

}  // namespace
}  // namespace lamina::oracle
