// The foot of a print: its first layers move inwards by more than the others.

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "plane/region/boolean.h"
#include "plane/region/offset.h"
#include "plane/region/region.h"
#include "slicer/contour/compensate.h"
#include "slicer/contour/layer_measures.h"
#include "slicer/slice/slice.h"
#include "tests/support/design.h"

namespace lamina::slicer {
namespace {

using plane::Region;
using support::Design;

constexpr double kLayer = 0.1;

Settings settings_with(Foot foot, double contour = 0) {
  Settings settings;
  settings.layer_thickness = kLayer;
  settings.tolerance = 0;
  settings.compensation = contour;
  settings.foot = foot;
  return settings;
}

std::vector<Layer> layers_of(const std::string& text,
                             const Settings& settings) {
  return support::slice_layers(Design::from_text(text).scene(), settings);
}

TEST(Foot, FadesEvenlyToNothing) {
  const Foot foot = {0.3, 3};
  EXPECT_DOUBLE_EQ(foot.of(0), 0.3);
  EXPECT_DOUBLE_EQ(foot.of(1), 0.2);
  EXPECT_DOUBLE_EQ(foot.of(2), 0.1);
  EXPECT_EQ(foot.of(3), 0);
  EXPECT_EQ((Foot{0.3, 1}.of(0)), 0.3);
  EXPECT_EQ((Foot{0.3, 1}.of(1)), 0);
}

TEST(Foot, ABlockIsSmallerInItsFirstLayers) {
  for (const unsigned threads : {1U, 3U}) {
    Settings settings = settings_with({0.2, 4}, 0.05);
    settings.threads = threads;
    const auto layers = layers_of("cube([10, 6, 5]);", settings);
    ASSERT_EQ(layers.size(), 50U);
    for (std::size_t i = 0; i < layers.size(); ++i) {
      const double inset =
          0.05 + (i < 4 ? 0.05 * (4 - static_cast<double>(i)) : 0);
      EXPECT_NEAR(layers[i].compensation, inset, 1e-12) << i;
      EXPECT_NEAR(measure(layers[i].contours).area,
                  (10 - 2 * inset) * (6 - 2 * inset), 1e-6)
          << i;
    }
  }
}

TEST(Foot, NothingChangesAboveItNorWithoutIt) {
  const std::string text =
      "difference() { cylinder(r1 = 5, r2 = 3, h = 4, $fn = 40); cylinder(r = "
      "1, h = 9, center = true, $fn = 20); }";
  const auto plain = layers_of(text, settings_with({0, 3}));
  const auto none = layers_of(text, settings_with({0, 9}));
  const auto foot = layers_of(text, settings_with({0.2, 5}));
  ASSERT_EQ(plain.size(), foot.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_EQ(plain[i].contours.points, none[i].contours.points) << i;
    EXPECT_EQ(plain[i].contours.points == foot[i].contours.points, i >= 5) << i;
  }
}

// The first layer is the first of the solid, wherever its leaves begin.
TEST(Foot, BeginsWhereTheSolidBegins) {
  const auto layers = layers_of(
      "difference() { translate([0, 0, -3]) cube([6, 6, 5]); translate([-1, "
      "-1, -4]) cube([8, 8, 4]); }",
      settings_with({0.2, 2}));
  ASSERT_EQ(layers.size(), 20U);
  EXPECT_NEAR(layers[0].compensation, 0.2, 1e-12);
  EXPECT_NEAR(layers[1].compensation, 0.1, 1e-12);
  EXPECT_EQ(layers[2].compensation, 0);
}

// Cut at the heights of the layers, all are as in the layers.
TEST(Foot, SectionsAtHeightsAreThoseOfTheLayersThere) {
  const std::string text =
      "translate([0, 0, 1]) cylinder(r1 = 5, r2 = 3, h = 4);";
  Settings settings = settings_with({0.2, 5});
  const auto layers = layers_of(text, settings);
  for (const Layer& layer : layers) {
    settings.heights = {layer.section_z};
    const auto alone = layers_of(text, settings);
    ASSERT_EQ(alone.size(), 1U);
    EXPECT_EQ(alone[0].contours.points, layer.contours.points);
    EXPECT_EQ(alone[0].compensation, layer.compensation);
  }
}

// A printer that grows its first layers by as much makes the design. Of
// contours whose corners are convex and blunt: growing rounds the others.
TEST(Foot, APrinterWhoseFootGrowsMakesTheDesign) {
  const Foot foot = {0.2, 4};
  for (const char* text : {"cylinder(r1 = 4, r2 = 3, h = 3, $fn = 90);",
                           "difference() { cylinder(r = 4, h = 3, $fn = 90); "
                           "translate([1, 0, -1]) "
                           "cylinder(r = 1, h = 9, $fn = 90); }"}) {
    const auto nominal = layers_of(text, settings_with({}));
    const auto layers = layers_of(text, settings_with(foot));
    ASSERT_EQ(nominal.size(), layers.size());
    for (std::size_t i = 0; i < layers.size(); ++i) {
      const double growth = foot.of(static_cast<std::uint32_t>(i));
      const Region printed =
          growth == 0 ? plane::to_region(layers[i].contours)
                      : plane::offset(plane::to_region(layers[i].contours),
                                      growth, plane::Join::kMiter, 1e-4);
      EXPECT_NEAR(plane::area(printed), measure(nominal[i].contours).area,
                  1e-3 * measure(nominal[i].contours).area)
          << text << i;
    }
  }
}

TEST(Foot, PartsThatAreTooNarrowForItAreCounted) {
  Diagnostics diagnostics;
  const Design design =
      Design::from_text("cube(5); translate([9, 0, 0]) cube([0.3, 3, 3]);");
  const Settings settings = settings_with({0.2, 4});
  LayerDrain sink;
  const SliceReport report =
      slice(design.scene(), plan_layers(design.scene(), settings), settings,
            sink, diagnostics);
  // Insets of 0.2 and 0.15 mm leave nothing of 0.3 mm.
  EXPECT_EQ(report.losses.vanished_regions, 2U);
  ASSERT_EQ(diagnostics.all().size(), 1U);
  EXPECT_NE(diagnostics.all()[0].message.find("of 0.4 mm or less vanished"),
            std::string::npos);
}

}  // namespace
}  // namespace lamina::slicer
