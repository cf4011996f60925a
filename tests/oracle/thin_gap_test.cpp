// Gaps and walls far thinner than the pitch, along x, along y and turned by
// 37 degrees, are what rows of rays lose. Here every layer must equal its exact
// section.

#include <fstream>
#include <sstream>
#include <string>
#include <tuple>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/oracle/exact_region.h"
#include "tests/oracle/judge.h"
#include "tests/oracle/world_scene.h"
#include "tests/support/contour_checks.h"
#include "tests/support/design.h"

namespace lamina::oracle {
namespace {

// The benchmark's scene with gaps of another width.
support::Design thin_gap(double width) {
  std::ifstream file(LAMINA_BENCH_SCENES "/thin_gap.scad");
  std::ostringstream text;
  text << file.rdbuf();
  std::string design = text.str();
  const std::string assignment = "g = 0.01;";
  design.replace(design.find(assignment), assignment.size(),
                 fmt::format("g = {};", width));
  return support::Design::from_text(design);
}

// Three plates with five gaps each, and below z = 0.3 three plates, above it
// their five walls each.
RegionCounts counts_by_formula(double z) {
  constexpr std::size_t kPlates = 3;
  constexpr std::size_t kGaps = 5;
  return {kPlates + (z < 0.3 ? kPlates : kPlates * kGaps), kPlates * kGaps};
}

class ThinGap : public ::testing::TestWithParam<std::tuple<double, double>> {};

TEST_P(ThinGap, IsInEveryLayerAsInTheExactSection) {
  const auto [width, pitch] = GetParam();
  const support::Design design = thin_gap(width);
  const WorldScene world = world_scene(design.scene());
  for (const double tolerance : {0.0, 0.001}) {
    slicer::Settings settings;
    settings.ray_pitch = pitch;
    settings.tolerance = tolerance;
    Allowance allowance = kExactAllowance;
    allowance.distance += tolerance;
    const auto layers = support::slice_layers(design.scene(), settings);
    EXPECT_EQ(layers.size(), 40U);
    for (const slicer::Layer& layer : layers) {
      EXPECT_TRUE(support::are_sound(layer.contours));
      const Verdict verdict = judge(exact_section(world, layer.section_z),
                                    layer.contours, allowance);
      EXPECT_EQ(verdict.complaint, "") << "z = " << layer.section_z;
      EXPECT_EQ(verdict.counts, counts_by_formula(layer.section_z))
          << "z = " << layer.section_z;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Oracle, ThinGap,
                         ::testing::Combine(::testing::Values(0.1, 0.01, 0.001),
                                            ::testing::Values(0.0762, 0.5)));

}  // namespace
}  // namespace lamina::oracle
