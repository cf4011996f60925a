// Stacks of layers compared: which layers belong together, and what is told of
// them.

#include "slicer/check/compare/compare.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/diagnostic.h"
#include "tests/slicer/formats/writing.h"

namespace lamina::slicer {
namespace {

const std::vector<Vec2> kSquareLoop = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
const std::vector<Vec2> kHole = {{2, 2}, {2, 4}, {5, 4}, {5, 2}};

std::vector<Layer> squares(double first, double step, int count) {
  std::vector<Layer> layers;
  for (int i = 0; i < count; ++i) {
    const double bottom = first + i * step;
    layers.push_back(layer_at(bottom, bottom + step, {kSquareLoop}));
  }
  return layers;
}

std::string pairing_error(const std::vector<Layer>& a,
                          const std::vector<Layer>& b) {
  try {
    pair_layers(a, b, 0, "a.slc", "b.svg");
  } catch (const GeometryError& error) {
    return error.what();
  }
  return {};
}

TEST(PairLayers, WithinTheRoundingOfHeights) {
  const std::vector<Layer> a = squares(0, 0.05, 20);
  const std::vector<Layer> b = squares(1e-5, 0.05, 20);
  const std::vector<LayerPair> pairs = pair_layers(a, b, 0, "a", "b");
  ASSERT_EQ(pairs.size(), 20U);
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(pairs[i].a, &a[i]);
    EXPECT_EQ(pairs[i].b, &b[i]);
  }
}

TEST(PairLayers, WhatReachesFartherStaysAlone) {
  const std::vector<Layer> a = squares(0, 0.5, 4);
  std::vector<Layer> b = squares(1, 0.5, 4);
  b.push_back(layer_at(3, 3.5, {}));  // nothing to compare
  const std::vector<LayerPair> pairs = pair_layers(a, b, 0, "a", "b");
  ASSERT_EQ(pairs.size(), 6U);
  EXPECT_EQ(pairs[0].b, nullptr);
  EXPECT_EQ(pairs[2].a, &a[2]);
  EXPECT_EQ(pairs[2].b, &b[0]);
  EXPECT_EQ(pairs[5].a, nullptr);
  EXPECT_EQ(pair_layers(a, squares(1, 0.5, 4), -1, "a", "b").size(), 4U);
}

TEST(PairLayers, RefusesOtherHeights) {
  EXPECT_NE(pairing_error(squares(0, 0.05, 20), squares(0, 0.1, 10))
                .find("b.svg has one at z 0.05, a.slc has its nearest at z "),
            std::string::npos);
}

TEST(PairLayers, RefusesLayersThatDoNotRise) {
  std::vector<Layer> falling = squares(0, 0.05, 3);
  falling.push_back(falling[1]);
  EXPECT_NE(pairing_error(falling, squares(0, 0.05, 3))
                .find("a.slc: layer 4 at z 0.075 is not higher"),
            std::string::npos);
}

TEST(PairLayers, AnEmptyLayerNeedsNoPartner) {
  std::vector<Layer> a = squares(0, 1, 3);
  a[1].contours.clear();
  std::vector<Layer> b = squares(0, 1, 3);
  b.erase(b.begin() + 1);
  EXPECT_EQ(pair_layers(a, b, 0, "a", "b").size(), 2U);
}

// A square; a square with a hole in a alone; a square that is longer in b.
std::vector<LayerDifference> three_layers() {
  const std::vector<Layer> a = {layer_at(0, 0.5, {kSquareLoop}),
                                layer_at(0.5, 1, {kSquareLoop, kHole}),
                                layer_at(1, 1.5, {kSquareLoop})};
  const std::vector<Layer> b = {
      layer_at(0, 0.5, {kSquareLoop}), layer_at(0.5, 1, {kSquareLoop}),
      layer_at(1, 1.5, {{{0, 0}, {10, 0}, {10, 10.25}, {0, 10.25}}})};
  return compare(pair_layers(a, b, 0, "a", "b"), Vec2(0));
}

TEST(Compare, NumbersLayersFromOne) {
  const std::vector<LayerDifference> layers = three_layers();
  ASSERT_EQ(layers.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(layers[i].number, i + 1);
}

TEST(Compare, EqualLayersDifferInNothing) {
  const LayerDifference layer = three_layers()[0];
  EXPECT_EQ(layer.area(), 0);
  EXPECT_EQ(layer.distance.distance, 0);
}

TEST(Compare, AHoleOfOneOnlyIsCountedAndMeasured) {
  const LayerDifference layer = three_layers()[1];
  EXPECT_EQ(layer.loops_a, (LoopCount{1, 1}));
  EXPECT_EQ(layer.loops_b, (LoopCount{1, 0}));
  EXPECT_NEAR(layer.areas.only_b, 6, 1e-12);
  // The hole's corner (5, 4) is 4 from the square, its side's middle no more.
  EXPECT_NEAR(layer.distance.distance, 4, 1e-6);
}

TEST(Compare, ASideThatMovedIsMeasured) {
  const LayerDifference layer = three_layers()[2];
  EXPECT_NEAR(layer.areas.only_b, 2.5, 1e-12);
  EXPECT_DOUBLE_EQ(layer.distance.distance, 0.25);
}

TEST(SumUp, CountsLayersBeyondTheToleranceAndOfOtherLoops) {
  const ComparisonTotals totals = sum_up(three_layers(), 0.25);
  EXPECT_EQ(totals.layers, 3U);
  EXPECT_EQ(totals.outside, 1U);
  EXPECT_EQ(totals.other_loops, 1U);
}

TEST(SumUp, FindsTheWorstLayer) {
  EXPECT_EQ(sum_up(three_layers(), 0.25).worst, 1U);
}

TEST(SumUp, AddsUpVolumes) {
  const ComparisonTotals totals = sum_up(three_layers(), 0.25);
  EXPECT_NEAR(totals.volume_a, 147, 1e-9);
  EXPECT_NEAR(totals.volume_only_a, 0, 1e-9);
  EXPECT_NEAR(totals.volume_only_b, 4.25, 1e-9);
}

TEST(Compare, SliversCountForAreasOnly) {
  const std::vector<Vec2> sliver = {{4, 4}, {6, 4}, {6, 4 + 2e-6}};
  const LayerDifference difference =
      compare_layers(layer_at(0, 1, {kSquareLoop}).contours,
                     layer_at(0, 1, {kSquareLoop, sliver}).contours);
  EXPECT_EQ(difference.distance.distance, 0);
  EXPECT_EQ(difference.loops_b.regions, 2U);
}

TEST(Compare, ASliverAloneHasNoDistance) {
  const std::vector<Vec2> sliver = {{4, 4}, {6, 4}, {6, 4 + 2e-6}};
  const LayerDifference alone =
      compare_layers({}, layer_at(0, 1, {sliver}).contours);
  EXPECT_EQ(alone.distance.distance, 0);
  EXPECT_NEAR(alone.areas.only_b, 2e-6, 1e-12);
}

TEST(Compare, AShiftMakesMovedPartsEqual) {
  const std::vector<Layer> a = squares(1, 0.5, 4);
  std::vector<Layer> b = squares(0, 0.5, 4);
  for (Layer& layer : b) {
    for (Vec2& point : layer.contours.points) point -= Vec2(30, -20);
  }
  const Vec3 shift = aligning_shift(a, b);
  EXPECT_EQ(shift, Vec3(30, -20, 1));
  for (const LayerDifference& layer :
       compare(pair_layers(a, b, shift.z, "a", "b"), Vec2(shift.x, shift.y))) {
    EXPECT_EQ(layer.area(), 0);
    EXPECT_EQ(layer.distance.distance, 0);
  }
}

TEST(AligningShift, IsNothingWithoutContours) {
  EXPECT_EQ(aligning_shift(squares(1, 0.5, 4), {}), Vec3(0));
}

}  // namespace
}  // namespace lamina::slicer
