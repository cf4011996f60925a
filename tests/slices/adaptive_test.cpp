// Adaptive layers (--adaptive) against closed formulas: the cusp bound holds
// in every layer, and no layer is thinner than it must be.

#include "slicer/plan/adaptive.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "plane/contours.h"
#include "plane/loop_area.h"
#include "tests/support/design.h"

namespace lamina {
namespace {

using slicer::Settings;
using support::Design;

Settings settings_for(double cusp, double layer, double greatest = 0) {
  Settings settings;
  settings.cusp = cusp;
  settings.layer_thickness = layer;
  settings.greatest_thickness = greatest;
  return settings;
}

ldni::LayerGrid grid_of(const std::string& text, const Settings& settings) {
  return slicer::adaptive_grid(
      Design::from_text(text).scene(),
      {settings.layer_thickness, settings.greatest_thickness, settings.cusp});
}

// Thicknesses in units of the thinnest.
std::vector<unsigned> multiples(const ldni::LayerGrid& grid, double unit) {
  std::vector<unsigned> result;
  for (std::uint32_t i = 0; i < grid.layer_count(); ++i) {
    const double multiple = (grid.layer_top(i) - grid.layer_bottom(i)) / unit;
    EXPECT_NEAR(multiple, std::round(multiple), 1e-6);
    result.push_back(static_cast<unsigned>(std::lround(multiple)));
  }
  return result;
}

// A strip of faces around an axis: from a height to another, under a slope.
struct Strip {
  double low;
  double high;
  double steepness;  // |n_z|
};

// Fewest layers from ply limits: taking the thickest that is allowed is best,
// since what is allowed stays so when it is made smaller.
std::size_t fewest_layers(const std::vector<Strip>& strips, double cusp,
                          double unit, int greatest) {
  double bottom = 1e300;
  double top = -1e300;
  for (const Strip& strip : strips) {
    bottom = std::min(bottom, strip.low);
    top = std::max(top, strip.high);
  }
  const auto is_allowed = [&](int from, int plies) {
    if (plies == 1) return true;
    const double low = bottom + from * unit;
    const double high = low + plies * unit;
    for (const Strip& strip : strips) {
      if (strip.low >= high - 1e-6 || strip.high <= low + 1e-6) continue;
      if (plies * unit * strip.steepness > cusp + 1e-9) return false;
      if (strip.high == strip.low) return false;  // flat
    }
    return true;
  };
  const int count = static_cast<int>(std::ceil((top - bottom) / unit - 0.5));
  std::size_t layers = 0;
  for (int from = 0; from < count; ++layers) {
    int plies = 1;
    while (plies < greatest && from + plies < count &&
           is_allowed(from, plies + 1)) {
      ++plies;
    }
    from += plies;
  }
  return layers;
}

// OpenSCAD's sphere: rings at polar angles (i + 1/2)·180°/rings, flat caps.
std::vector<Strip> sphere_strips(double radius, int fragments) {
  const int rings = (fragments + 1) / 2;
  std::vector<Vec2> profile;  // radius, height
  for (int i = 0; i < rings; ++i) {
    const double phi = M_PI * (i + 0.5) / rings;
    profile.emplace_back(radius * std::sin(phi), radius * std::cos(phi));
  }
  std::vector<Strip> strips;
  // cppcheck-suppress containerOutOfBounds ; there are rings
  for (const Vec2& cap : {profile.front(), profile.back()}) {
    strips.push_back({cap.y, cap.y, 1});
  }
  // Sides are flat: seen from the axis their middles are nearer than corners.
  const double inward = std::cos(M_PI / fragments);
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const double run = (profile[i + 1].x - profile[i].x) * inward;
    const double rise = profile[i + 1].y - profile[i].y;
    strips.push_back({profile[i + 1].y, profile[i].y,
                      std::abs(run) / std::hypot(run, rise)});
  }
  return strips;
}

TEST(AdaptiveGrid, OfASphereHasTheFewestLayersThatTheCuspAllows) {
  for (const double cusp : {0.02, 0.05, 0.08, 0.3}) {
    for (const int fragments : {8, 30, 101}) {
      const ldni::LayerGrid grid =
          grid_of(fmt::format("sphere(3, $fn = {});", fragments),
                  settings_for(cusp, 0.02, 0.16));
      EXPECT_EQ(grid.layer_count(),
                fewest_layers(sphere_strips(3, fragments), cusp, 0.02, 8))
          << cusp << ' ' << fragments;
    }
  }
}

TEST(AdaptiveGrid, OfAConeHasOneThickness) {
  // A slope of 45°: cusp = t / √2.
  const std::string cone = "cylinder(r1 = 4, r2 = 0, h = 4, $fn = 4);";
  // Four sides: their slope is that of the apothem, 4/√2 to 4.
  const double steepness = 1 / std::sqrt(1 + 2.0);
  for (unsigned plies = 1; plies <= 5; ++plies) {
    const double cusp = plies * 0.05 * steepness;
    const auto layers =
        multiples(grid_of(cone, settings_for(cusp, 0.05, 1)), 0.05);
    // All are as thick but the one that takes what is left of 80 plies.
    EXPECT_EQ(layers.size(), (80U + plies - 1) / plies);
    EXPECT_LE(std::count_if(layers.begin(), layers.end(),
                            [&](unsigned layer) { return layer != plies; }),
              1);
  }
}

TEST(AdaptiveGrid, FlatFacesLieOnBordersOrInTheThinnestLayers) {
  // 0.55 is a border of plies of 0.05, 0.77 is none.
  const ldni::LayerGrid grid =
      grid_of("cube([2, 2, 2]); cube([3, 2, 0.55]); cube([2, 3, 0.77]);",
              settings_for(0.01, 0.05, 0.4));
  bool is_border = false;
  for (std::uint32_t i = 0; i < grid.layer_count(); ++i) {
    const double low = grid.layer_bottom(i);
    const double high = grid.layer_top(i);
    if (std::abs(low - 0.55) < 1e-9) is_border = true;
    if (low < 0.77 - 1e-9 && 0.77 + 1e-9 < high) {
      EXPECT_NEAR(high - low, 0.05, 1e-9);
    }
  }
  EXPECT_TRUE(is_border);
  // 0 to 0.55 in 2 layers, to 0.75 in 1, 0.05, and 1.2 in 3.
  EXPECT_EQ(multiples(grid, 0.05).size(), 7U);
}

TEST(AdaptiveGrid, PeaksLieInTheThinnestLayers) {
  // A spire whose sides allow any layer, and that ends within one.
  const std::string text =
      "cube([4, 4, 3]); translate([1, 1, 0]) cylinder(r1 = 0.5, r2 = 0, "
      "h = 5.02, $fn = 40); translate([3, 3, 0]) cube([0.5, 0.5, 6]);";
  const ldni::LayerGrid grid = grid_of(text, settings_for(0.2, 0.05, 0.2));
  for (std::uint32_t i = 0; i < grid.layer_count(); ++i) {
    if (grid.layer_bottom(i) > 5.02 || grid.layer_top(i) < 5.02) continue;
    EXPECT_NEAR(grid.layer_top(i) - grid.layer_bottom(i), 0.05, 1e-9);
  }
}

TEST(AdaptiveGrid, WhatTheBooleanHidesHasNoSay) {
  const auto layers = [](const std::string& text) {
    return grid_of(text, settings_for(0.01, 0.05)).layer_count();
  };
  const auto plain = layers("cylinder(r = 5, h = 8, $fn = 60);");
  EXPECT_EQ(plain, 40U);
  EXPECT_EQ(layers("cylinder(r = 5, h = 8, $fn = 60);"
                   "translate([0, 0, 4]) sphere(2, $fn = 60);"),
            plain);
  EXPECT_EQ(layers("difference() { cylinder(r = 5, h = 8, $fn = 60);"
                   "translate([0, 0, -1.23]) cylinder(r = 2, h = 11); "
                   "translate([20, 0, 3]) sphere(4); }"),
            plain);
  EXPECT_GT(layers("difference() { cylinder(r = 5, h = 8, $fn = 60);"
                   "translate([5, 0, 4]) sphere(2, $fn = 60); }"),
            plain);
}

TEST(AdaptiveGrid, BeginsAtTheLowestPointOfTheSurface) {
  const ldni::LayerGrid grid = grid_of(
      "difference() { translate([0, 0, -3]) cube([4, 4, 5]);"
      "translate([-1, -1, -10]) cube([6, 6, 9.03]); }",
      settings_for(0.05, 0.05));
  EXPECT_NEAR(grid.layer_bottom(0), -0.97, 1e-6);
}

TEST(AdaptiveGrid, RefusesMoreThinLayersThanItCanPlan) {
  EXPECT_THROW(grid_of("cube([1, 1, 1e6]);", settings_for(0.05, 1e-4)), Error);
}

std::size_t count_runs(const std::vector<unsigned>& sizes) {
  std::size_t runs = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    runs += i == 0 || sizes[i] != sizes[i - 1] ? 1 : 0;
  }
  return runs;
}

TEST(AdaptiveGrid, HasMoreLayersWhereAFormatTellsOfFewRuns) {
  const Design ball = Design::from_text("sphere(3, $fn = 100);");
  slicer::AdaptiveThickness thickness{0.02, 0.16, 0.02};
  const auto free = multiples(adaptive_grid(ball.scene(), thickness), 0.02);
  thickness.most_runs = 4;
  const auto kept = multiples(adaptive_grid(ball.scene(), thickness), 0.02);
  EXPECT_GT(count_runs(free), 4U);
  EXPECT_LE(count_runs(kept), 4U);
  EXPECT_GT(kept.size(), free.size());
}

TEST(AdaptiveLayers, HoldTheVolumeOfTheSolid) {
  // Sections in the middle: errors of the second order only.
  const Design ball = Design::from_text("sphere(5, $fn = 200);");
  Settings settings = settings_for(0.04, 0.02, 0.16);
  settings.tolerance = 0;
  double volume = 0;
  double top = 0;
  for (const auto& layer : support::slice_layers(ball.scene(), settings)) {
    if (top != 0) {
      EXPECT_EQ(layer.bottom, top);
    }
    top = layer.top;
    for (std::size_t i = 0; i < layer.contours.loop_count(); ++i) {
      volume +=
          signed_area(layer.contours.loop(i)) * (layer.top - layer.bottom);
    }
  }
  EXPECT_NEAR(volume / (4.0 / 3 * M_PI * 125), 1, 1e-3);
}

}  // namespace
}  // namespace lamina
