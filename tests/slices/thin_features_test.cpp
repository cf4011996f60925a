// Walls and gaps far thinner than the pitch, and faces that coincide.

#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/contour_checks.h"
#include "tests/support/design.h"

namespace lamina {
namespace {

using support::Design;
using support::LoopCounts;

std::size_t loops_of_thin_gap(double pitch) {
  const Design design = Design::from_file(LAMINA_BENCH_SCENES "/thin_gap.scad");
  slicer::Settings settings;
  settings.layer_thickness = 0.0762;
  settings.ray_pitch = pitch;
  std::size_t loops = 0;
  for (const auto& layer : support::slice_layers(design.scene(), settings)) {
    EXPECT_TRUE(support::are_sound(layer.contours)) << layer.section_z;
    loops += layer.contours.loop_count();
  }
  return loops;
}

// 26 layers of three plates with five gaps; three plates below 0.3 mm in four
// of them, fifteen walls in the other 22.
TEST(ThinFeatures, GapsAndWallsOfAHundredthSurviveAnyPitch) {
  for (const double pitch : {0.5, 0.0762, 0.0}) {
    EXPECT_EQ(loops_of_thin_gap(pitch), 26U * 18 + 4 * 3 + 22 * 15) << pitch;
  }
}

// Gaps along x, along y and turned, down to some tie distances.
TEST(ThinFeatures, GapsAreThereInEveryDirection) {
  for (const double gap : {0.1, 0.01, 0.001, 0.0001, 0.00002}) {
    for (const double angle_deg : {0.0, 90.0, 37.0, 1.0}) {
      const Design design = Design::from_text(
          fmt::format("rotate({}) difference() {{ cube([6, 6, 2]);"
                      "  for (i = [1:5]) translate([i - {} / 2, 0.5, -1])"
                      "    cube([{}, 5, 4]); }}",
                      angle_deg, gap, gap));
      const auto layers =
          support::slice_heights(design.scene(), {0.3, 1.7}, 0.5);
      for (const auto& layer : layers) {
        EXPECT_EQ(support::count_loops(layer.contours), (LoopCounts{1, 5}))
            << gap << " at " << angle_deg;
        EXPECT_NEAR(support::total_area(layer.contours), 36 - 25 * gap, 1e-8);
      }
    }
  }
}

TEST(ThinFeatures, ACoplanarDifferenceLeavesNoSkin) {
  for (const std::string turn :
       {"", "rotate(90)", "rotate(37)", "rotate([10, 20, 30])"}) {
    const Design design = Design::from_text(
        turn +
        " difference() { cube([9, 9, 9]);"
        "  cube([3, 3, 9]); translate([6, 2, 0]) cube([3, 3, 9]);"
        "  translate([2, 7, 0]) cube([2, 2, 9]); }");
    const double low = design.scene().box.low.z;
    const double high = design.scene().box.high.z;
    std::vector<double> heights;
    for (const double share : {0.37, 0.5, 0.61}) {
      heights.push_back(low + share * (high - low));
    }
    for (const auto& layer : support::slice_heights(design.scene(), heights)) {
      EXPECT_TRUE(support::are_sound(layer.contours)) << turn;
      EXPECT_EQ(layer.contours.loop_count(), 1U) << turn;
    }
  }
}

TEST(ThinFeatures, SolidsThatTouchUniteWithoutAnInnerWall) {
  for (const std::string turn :
       {"", "rotate(90)", "rotate(37)", "rotate(1e-7)"}) {
    const Design design = Design::from_text(
        turn + " { for (i = [0:4], j = [0:4]) translate([i, j, 0]) cube(1); }");
    const auto layers = support::slice_heights(design.scene(), {0.5});
    EXPECT_EQ(support::count_loops(layers[0].contours), (LoopCounts{1, 0}))
        << turn;
    EXPECT_EQ(layers[0].contours.points.size(), 4U) << turn;
    EXPECT_NEAR(support::total_area(layers[0].contours), 25, 1e-8) << turn;
  }
}

}  // namespace
}  // namespace lamina
