#include "slicer/check/print/layer_overlay.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "tests/slicer/check/print/cell_layers.h"

namespace lamina::slicer {
namespace {

LayerOverlay overlay_of(const plane::Contours& below,
                        const plane::Contours& above, double reach) {
  OverlaySweep sweep;
  LayerOverlay overlay;
  sweep.start(below);
  sweep.lay_over(above, reach, overlay);
  return overlay;
}

constexpr double kWidth = 0.5;

// All pairs of regions that share a cell.
std::vector<Overlap> shared_cells(const CellLayer& below,
                                  const CellLayer& above, bool is_solid) {
  const auto regions_below = below.regions();
  const auto regions_above = above.regions();
  std::set<Overlap> overlaps;
  for (int y = 0; y < CellLayer::kSize; ++y) {
    for (int x = 0; x < CellLayer::kSize; ++x) {
      const auto i = static_cast<std::size_t>(y * CellLayer::kSize + x);
      if (below.is_solid(x, y) == is_solid &&
          above.is_solid(x, y) == is_solid) {
        overlaps.insert({regions_below[i], regions_above[i]});
      }
    }
  }
  return {overlaps.begin(), overlaps.end()};
}

double distance_to_solid(const CellLayer& layer, double x, double y) {
  double least = 1e300;
  for (int row = 0; row < CellLayer::kSize; ++row) {
    for (int column = 0; column < CellLayer::kSize; ++column) {
      if (!layer.is_solid(column, row)) continue;
      const double dx = std::max({column - x, 0.0, x - column - 1});
      const double dy = std::max({row - y, 0.0, y - row - 1});
      least = std::min(least, std::hypot(dx, dy));
    }
  }
  return kWidth * least;
}

// The greatest distance [mm] to the solid below of places in region i above,
// five by five in a cell.
double greatest_distance(const CellLayer& below, const CellLayer& above,
                         std::uint32_t i) {
  const auto regions = above.regions();
  double greatest = 0;
  for (int y = 0; y < CellLayer::kSize; ++y) {
    for (int x = 0; x < CellLayer::kSize; ++x) {
      if (regions[static_cast<std::size_t>(y * CellLayer::kSize + x)] != i ||
          below.is_solid(x, y)) {
        continue;
      }
      for (int k = 0; k < 25; ++k) {
        greatest = std::max(greatest, distance_to_solid(below, x + k % 5 * 0.25,
                                                        y + k / 5 * 0.25));
      }
    }
  }
  return greatest;
}

void expect_as_by_cells(const CellLayer& below, const CellLayer& above,
                        double angle, double reach) {
  const LayerOverlay overlay = overlay_of(below.contours(kWidth, angle),
                                          above.contours(kWidth, angle), reach);
  EXPECT_EQ(overlay.solids, shared_cells(below, above, true));
  EXPECT_EQ(overlay.voids, shared_cells(below, above, false));
  EXPECT_EQ(overlay.around, above.around());
  for (std::uint32_t i = 0; i < overlay.areas.size(); ++i) {
    if (overlay.areas[i] < 0) continue;
    double found = 0;
    for (const Overhang& overhang : overlay.overhangs) {
      if (overhang.region == i) found = std::max(found, overhang.distance);
    }
    const bool is_held = std::ranges::any_of(
        overlay.solids,
        [i](const Overlap& overlap) { return overlap.above == i; });
    const double greatest = is_held ? greatest_distance(below, above, i) : 0.0;
    // Places are 0.1 mm apart there, and 0.125 mm here.
    constexpr double kSlack = 0.1;
    if (greatest > reach + kSlack) {
      EXPECT_NEAR(found, greatest, kSlack + 0.1 * greatest);
    } else if (greatest < reach - kSlack) {
      EXPECT_EQ(found, 0);
    }
  }
}

TEST(OverlaySweep, FindsWhatCellsShare) {
  std::mt19937 random(1);
  for (unsigned trial = 0; trial < 600; ++trial) {
    SCOPED_TRACE(trial);
    const CellLayer below = CellLayer::any(random, 30 + trial % 50);
    const CellLayer above =
        trial % 2 == 0 ? CellLayer::any(random, 30 + trial % 50)
                       : below.changed(random, static_cast<int>(trial / 2 % 6));
    const double angle = trial % 3 == 0 ? 0 : 0.001 * trial;
    expect_as_by_cells(below, above, angle, trial % 5 == 0 ? 0.45 : 0.3);
  }
}

}  // namespace
}  // namespace lamina::slicer
