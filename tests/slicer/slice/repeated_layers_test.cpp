// Layers that are as the one before are not made again. They must be what they
// would be if each were made alone.

#include <atomic>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/diagnostic.h"
#include "slicer/slice/slice.h"
#include "tests/support/design.h"

namespace lamina::slicer {
namespace {

// Upright walls but for a ball that the layers from 2 mm to 3 mm meet.
constexpr const char* kPost = R"(
difference() {
  union() {
    translate([1, 2, 0]) cube([6, 5, 4]);
    translate([6, 4, 0]) cylinder(r = 2, h = 5, $fn = 30);
    linear_extrude(3.5) translate([-3, 0]) difference() {
      circle(3, $fn = 7);
      translate([0.1, 0.2]) square(1);
    }
  }
  translate([4, 4, -1]) cylinder(d = 1.5, h = 9, $fn = 24);
  translate([1, 4, 2.5]) sphere(r = 0.5, $fn = 20);
})";

std::string text_of(const plane::Contours& contours) {
  std::string text;
  for (const Vec2& point : contours.points) {
    text += std::to_string(point.x) + ' ' + std::to_string(point.y) + '\n';
  }
  return text;
}

// Encodes, and counts how often.
class EncodingList : public support::LayerList {
 public:
  std::string encode(const Layer& layer) const override {
    ++encoded;
    return text_of(layer.contours);
  }
  void take_encoded(const Layer& layer, const std::string& text) override {
    take(layer);
    texts.push_back(text);
  }
  mutable std::atomic<int> encoded = 0;
  std::vector<std::string> texts;
};

class RepeatedLayers : public testing::Test {
 protected:
  RepeatedLayers() : design_(support::Design::from_text(kPost)) {
    settings_.layer_thickness = 0.02;
    settings_.compensation = 0.03;
  }
  SliceReport slice_to(LayerSink& sink) {
    Diagnostics diagnostics;
    return slice(design_.scene(), plan_layers(design_.scene(), settings_),
                 settings_, sink, diagnostics);
  }

  support::Design design_;
  Settings settings_;
};

TEST_F(RepeatedLayers, AreAsIfMadeAlone) {
  for (const unsigned threads : {1U, 3U}) {
    settings_.threads = threads;
    settings_.heights.clear();
    const auto layers = support::slice_layers(design_.scene(), settings_);
    ASSERT_EQ(layers.size(), 250U);
    for (const Layer& layer : layers) {
      settings_.heights = {layer.section_z};
      const auto alone = support::slice_layers(design_.scene(), settings_);
      ASSERT_EQ(alone.size(), 1U);
      EXPECT_EQ(layer.contours.points, alone[0].contours.points);
      EXPECT_EQ(layer.contours.ends, alone[0].contours.ends);
      EXPECT_EQ(layer.clearance, alone[0].clearance);
    }
  }
}

TEST_F(RepeatedLayers, AreNeitherSweptNorEncodedAgain) {
  EncodingList list;
  const SliceReport report = slice_to(list);
  ASSERT_EQ(list.layers.size(), 250U);
  // 50 layers meet the ball; of the others a few in each block are made.
  EXPECT_LT(report.sweep.layers, 120U);
  EXPECT_GT(report.sweep.layers, 50U);
  EXPECT_EQ(list.encoded, static_cast<int>(report.sweep.layers));
  ASSERT_EQ(list.texts.size(), 250U);
  for (std::size_t i = 0; i < list.layers.size(); ++i) {
    EXPECT_EQ(list.texts[i], text_of(list.layers[i].contours));
  }
}

TEST_F(RepeatedLayers, HaveTheirOwnHeights) {
  const auto layers = support::slice_layers(design_.scene(), settings_);
  ASSERT_EQ(layers.size(), 250U);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    EXPECT_NEAR(layers[i].bottom, 0.02 * static_cast<double>(i), 1e-9);
    EXPECT_NEAR(layers[i].section_z, layers[i].bottom + 0.01, 1e-9);
  }
}

}  // namespace
}  // namespace lamina::slicer
