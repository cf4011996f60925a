// Footprints: they hold all layers, and little more.

#include "slicer/plate/footprint.h"

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "plane/region/boolean.h"
#include "tests/slicer/plate/plate_checks.h"

namespace lamina::slicer {
namespace {

Layer layer_of(const plane::Region& region) {
  Layer layer;
  layer.contours = plane::to_contours(region);
  return layer;
}

// A wavy ring that grows and turns from layer to layer.
std::vector<Layer> wavy_ring(int layers, int corners) {
  std::vector<Layer> stack;
  for (int i = 0; i < layers; ++i) {
    plane::Region region;
    region.contours.resize(2);
    const double radius = 8 + 2 * std::sin(0.01 * i);
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * std::numbers::pi * k / corners;
      const double wave = 0.3 * std::sin(7 * angle + 0.02 * i);
      const Vec2 direction(std::cos(angle), std::sin(angle));
      region.contours[0].push_back((radius + wave) * direction);
      region.contours[1].insert(region.contours[1].begin(),
                                (radius - 1.5 + wave) * direction);
    }
    stack.push_back(layer_of(region));
  }
  return stack;
}

double area_outside(const Layer& layer, const plane::Region& footprint) {
  return area(plane::subtract(
      std::vector<plane::Region>{plane::to_region(layer.contours), footprint}));
}

TEST(FootprintOf, HoldsEveryLayerAndLittleMore) {
  const std::vector<Layer> layers = wavy_ring(120, 300);
  constexpr double kTolerance = 0.02;
  const plane::Region footprint = footprint_of(layers, kTolerance);
  std::vector<plane::Region> regions;
  for (const Layer& layer : layers) {
    EXPECT_LT(area_outside(layer, footprint), 1e-9);
    regions.push_back(plane::to_region(layer.contours));
  }
  const plane::Region exact = plane::unite(regions);
  for (const plane::Contour& contour : footprint.contours) {
    for (const Vec2 p : contour) {
      double nearest = 1e300;
      for (const plane::Contour& border : exact.contours) {
        for (std::size_t i = 0; i < border.size(); ++i) {
          nearest = std::min(
              nearest, distance_to_segment(p, border[i],
                                           border[(i + 1) % border.size()]));
        }
      }
      EXPECT_LE(nearest, 2 * kTolerance);
    }
  }
}

TEST(FootprintOf, SquaresOfSeveralLayersAreTheirUnion) {
  std::vector<Layer> layers;
  for (int i = 0; i < 10; ++i) {
    layers.push_back(layer_of(place(rectangle(4, 4), 0, Vec2(i, 0))));
  }
  EXPECT_NEAR(area(footprint_of(layers, 0.001)), 13 * 4, 34 * 0.002);
}

TEST(FootprintOf, NoLayersGiveNothing) {
  EXPECT_TRUE(footprint_of({}).is_empty());
  EXPECT_TRUE(footprint_of(std::vector<Layer>(3)).is_empty());
}

TEST(Place, QuarterTurnsAreExact) {
  const plane::Region turned = place(rectangle(4, 2), 270, {1, 1});
  const plane::Contour expected = {{1, 1}, {1, -3}, {3, -3}, {3, 1}};
  EXPECT_EQ(turned.contours.front(), expected);
}

}  // namespace
}  // namespace lamina::slicer
