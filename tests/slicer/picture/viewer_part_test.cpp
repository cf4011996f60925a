// What a browser gets of layers, read back as its script reads it.

#include "slicer/picture/viewer_part.h"

#include <cmath>
#include <cstdint>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "slicer/picture/viewer_template.h"

namespace lamina::slicer {
namespace {

using Json = nlohmann::json;

class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  std::uint64_t count() {
    std::uint64_t value = 0;
    for (int shift = 0;; shift += 7) {
      const auto byte = static_cast<unsigned char>(bytes_.at(place_++));
      value |= static_cast<std::uint64_t>(byte & 0x7F) << shift;
      if (byte < 0x80) return value;
    }
  }
  std::int64_t number() {
    const std::uint64_t value = count();
    const auto half = static_cast<std::int64_t>(value / 2);
    return value % 2 ? -half - 1 : half;
  }
  // The loops of a layer in millimetres; steps go on from the layer before.
  plane::Contours loops(Vec2 low, double step) {
    plane::Contours contours;
    const std::uint64_t loops = count();
    for (std::uint64_t i = 0; i < loops; ++i) {
      std::vector<Vec2> loop(count());
      for (Vec2& point : loop) {
        x_ += number();
        y_ += number();
        point =
            low + step * Vec2(static_cast<double>(x_), static_cast<double>(y_));
      }
      contours.add_loop(loop);
    }
    return contours;
  }
  bool is_at_end() const { return place_ == bytes_.size(); }

 private:
  std::string_view bytes_;
  std::size_t place_ = 0;
  std::int64_t x_ = 0;
  std::int64_t y_ = 0;
};

// A frame, and a triangle far from it.
Layer make_layer(double bottom, double size) {
  Layer layer;
  layer.bottom = bottom;
  layer.section_z = bottom + 0.025;
  layer.top = bottom + 0.05;
  const double s = size;
  layer.contours.add_loop(
      std::vector<Vec2>{{-3, 2}, {-3 + s, 2}, {-3 + s, 2 + s}, {-3, 2 + s}});
  layer.contours.add_loop(std::vector<Vec2>{
      {-2.5, 2.5}, {-2.5, 2.5003}, {-2.1234, 2.5003}, {-2.1234, 2.5}});
  layer.contours.add_loop(
      std::vector<Vec2>{{40.00049, 1}, {41, 1.3333333}, {40, 1.7}});
  return layer;
}

// Expects the same corners, but for rounding.
void expect_near(const plane::Contours& actual, const plane::Contours& expected,
                 double step) {
  ASSERT_EQ(actual.ends, expected.ends);
  for (std::size_t i = 0; i < expected.points.size(); ++i) {
    EXPECT_LE(std::abs(actual.points[i].x - expected.points[i].x),
              step / 2 + 1e-12);
    EXPECT_LE(std::abs(actual.points[i].y - expected.points[i].y),
              step / 2 + 1e-12);
  }
}

TEST(ViewerPart, ContoursAreReadBackInTheStepAskedFor) {
  const std::vector<Layer> layers = {make_layer(1, 6), make_layer(1.05, 7)};
  for (const double step : {1e-4, 1e-3}) {
    ViewerOptions options;
    options.title = "a<b>\n\"c\"";
    options.step = step;
    const ViewerPart part = viewer_part(layers, options);
    const Json facts = Json::parse(part.facts);
    EXPECT_EQ(facts["step"], step);
    const Vec2 low(facts["low"][0], facts["low"][1]);
    EXPECT_EQ(low, Vec2(-3, 1));
    ASSERT_EQ(facts["layers"].size(), 2U);
    Reader reader(part.contours);
    for (const Layer& layer : layers) {
      expect_near(reader.loops(low, step), layer.contours, step);
    }
    EXPECT_TRUE(reader.is_at_end());
  }
}

TEST(ViewerPart, ALayerByItselfIsThatOfThePart) {
  const std::vector<Layer> layers = {make_layer(1, 6), make_layer(1.05, 7)};
  const Box2 whole{{-3, 1}, {41, 9}};
  ViewerOptions options;
  options.step = 1e-3;
  const Json facts = Json::parse(viewer_part(layers, options).facts);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const ViewerLayer layer = viewer_layer(layers[i], whole, 1e-3);
    EXPECT_EQ(layer.step, 1e-3);
    EXPECT_EQ(Json::parse(layer.row), facts["layers"][i]);
    Reader reader(layer.contours);
    expect_near(reader.loops(whole.low, layer.step), layers[i].contours,
                layer.step);
    EXPECT_TRUE(reader.is_at_end());
  }
}

TEST(ViewerPart, AVastPartGetsACoarserStep) {
  const Box2 vast{{0, 0}, {2e7, 1}};
  EXPECT_DOUBLE_EQ(viewer_layer(make_layer(0, 1), vast, 1e-3).step, 1e-1);
}

TEST(ViewerTemplate, PiecesComeWhereTheyAreWanted) {
  const std::string page = viewer_html({.title = "a<b>",
                                        .head = "[head]",
                                        .tools = "[tools]",
                                        .panel = "[panel]",
                                        .tail = "[tail]"});
  std::size_t place = 0;
  for (const std::string_view piece :
       {"<title>a&lt;b&gt;</title>", "[head]", "</head>", "<header>", "[tools]",
        "id=\"fit\"", "</header>", "<main>", "[panel]", "id=\"solid\"",
        "</main>", "[tail]", "</body>"}) {
    const std::size_t found = page.find(piece, place);
    ASSERT_NE(found, std::string::npos) << piece;
    place = found + piece.size();
  }
  // A server that forbids them can serve it.
  EXPECT_EQ(page.find("style="), std::string::npos);
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_FALSE(std::regex_search(page, std::regex(R"(\son[a-z]+=)")));
  EXPECT_EQ(viewer_script().find("style=\""), std::string_view::npos);
}

}  // namespace
}  // namespace lamina::slicer
