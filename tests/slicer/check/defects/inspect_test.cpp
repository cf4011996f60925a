// What stands wrong in the heights of layers is a defect, and layers that do
// not touch hold nothing.

#include "slicer/check/defects/inspect.h"

#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/slicer/formats/writing.h"

namespace lamina::slicer {
namespace {

using Loops = std::vector<std::vector<Vec2>>;

const Loops kSquare = {{{0, 0}, {5, 0}, {5, 5}, {0, 5}}};
const Loops kFrame = {kSquare.front(), {{1, 1}, {1, 4}, {4, 4}, {4, 1}}};

Inspection inspect(const std::vector<Layer>& layers) {
  Inspector inspector({});
  for (const Layer& layer : layers) inspector.take(layer);
  return inspector.finish("a", {});
}

using Words = std::vector<std::string>;

TEST(Inspector, SearchesLoopsForDefectsWhereItIsAsked) {
  for (const bool finds_defects : {false, true}) {
    Inspector inspector({.finds_defects = finds_defects, .print = {}});
    inspector.take(
        layer_at(0, 1, {{{0, 0}, {5, 5}, {5, 0}, {0, 5}}}));  // crosses itself
    const Inspection found = inspector.finish("a", {});
    EXPECT_EQ(found.defects > 0, finds_defects);
    EXPECT_EQ(found.layers.size(), 1U);
  }
}

TEST(Inspector, LayersStandOneOnTheOther) {
  const auto defects = [](const std::vector<Layer>& layers) {
    return inspect(layers).reported_defects;
  };
  EXPECT_EQ(defects({layer_at(0, 0.5, kSquare), layer_at(0.5, 1, kSquare)}),
            Words{});
  EXPECT_EQ(
      defects({layer_at(0, 0.5, kSquare), layer_at(4, 4.5, kSquare)}),
      Words{"layer 2 at z 4: begins 3.5 mm above the end of the layer before"});
  EXPECT_EQ(defects({layer_at(0, 0.5, kSquare), layer_at(0.25, 0.75, kSquare)}),
            Words{"layer 2 at z 0.25: overlaps the layer before by 0.25 mm"});
  EXPECT_EQ(defects({layer_at(0, 0.5, kSquare), layer_at(0, 0.5, kSquare)}),
            Words{"layer 2 at z 0: not higher than the layer before"});
}

TEST(Inspector, AThicknessIsPositive) {
  const auto defects = [](const std::vector<Layer>& layers) {
    return inspect(layers).reported_defects;
  };
  EXPECT_EQ(
      defects({layer_at(0.5, 0.25, kSquare)}),
      Words{"layer 1 at z 0.5: its thickness, -0.25 mm, is not positive"});
  EXPECT_EQ(defects({layer_at(0, 0.5, kSquare), layer_at(0.5, 0.5, kSquare)}),
            Words{"layer 2 at z 0.5: its thickness, 0 mm, is not positive"});
}

TEST(Inspector, SectionsNeedNotTouch) {
  const Inspection found =
      inspect({layer_at(1, 1, kSquare), layer_at(4, 4, kSquare)});
  EXPECT_EQ(found.reported_defects, Words{});
  EXPECT_TRUE(found.print->findings.empty());
}

// 2000 layers of 0.05 mm, whose heights were added up in 32-bit numbers, and
// some from 10 m upwards, where two such numbers are 0.001 mm apart.
TEST(Inspector, RoundedHeightsAreNoDefects) {
  for (const float begin : {0.0F, 10000.0F}) {
    std::vector<Layer> layers;
    const float thickness = 0.05F;
    for (float z = begin; layers.size() < 2000; z += thickness) {
      layers.push_back(layer_at(z, double{z} + thickness, kSquare));
    }
    EXPECT_EQ(inspect(layers).defects, 0U) << begin;
  }
}

TEST(LayerGraph, NothingHoldsALayerAboveAGap) {
  const auto counts = [](double bottom) {
    const Inspection found = inspect(
        {layer_at(0, 0.5, kSquare), layer_at(bottom, bottom + 0.5, kSquare)});
    return std::vector<std::size_t>{
        found.print->count(FindingKind::kIsland),
        found.print->count(FindingKind::kLoosePart)};
  };
  EXPECT_EQ(counts(0.5), (std::vector<std::size_t>{0, 0}));
  EXPECT_EQ(counts(3), (std::vector<std::size_t>{0, 1}));
}

TEST(LayerGraph, AVoidOpensToAGap) {
  const auto traps = [](double lid) {
    return inspect({layer_at(0, 0.5, kSquare), layer_at(0.5, 1, kFrame),
                    layer_at(lid, lid + 0.5, kSquare)})
        .print->count(FindingKind::kResinTrap);
  };
  EXPECT_EQ(traps(1), 1U);
  EXPECT_EQ(traps(2), 0U);
}

}  // namespace
}  // namespace lamina::slicer
