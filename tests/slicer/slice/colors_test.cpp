// Contours of what has a color: those of a design of this alone.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "slicer/contour/layer_measures.h"
#include "slicer/slice/slice.h"
#include "tests/support/design.h"
#include "tests/support/random_design.h"

namespace lamina::slicer {
namespace {

using support::Design;

constexpr std::int32_t kRed = 0xff0000;
constexpr std::int32_t kBlue = 0x0000ff;

// Areas by color and height.
using Areas = std::map<std::int32_t, std::vector<double>>;

Settings settings_at(const std::vector<double>& heights) {
  Settings settings;
  settings.heights = heights;
  settings.tolerance = 0;
  return settings;
}

Areas colored_areas(const std::string& text,
                    const std::vector<double>& heights) {
  Settings settings = settings_at(heights);
  settings.keeps_colors = true;
  Areas areas;
  for (const Layer& layer :
       support::slice_layers(Design::from_text(text).scene(), settings)) {
    for (const ColoredPart& part : layer.colored) {
      areas[part.color].push_back(measure(part.contours).area);
    }
  }
  return areas;
}

std::vector<double> areas_of(const std::string& text,
                             const std::vector<double>& heights) {
  std::vector<double> areas;
  for (const Layer& layer : support::slice_layers(
           Design::from_text(text).scene(), settings_at(heights))) {
    areas.push_back(measure(layer.contours).area);
  }
  return areas;
}

std::vector<double> heights_of(const std::string& text) {
  const Design design = Design::from_text(text);
  const Box3& box = design.scene().box;
  std::vector<double> heights;
  for (int i = 0; i < 8; ++i) {
    heights.push_back(box.low.z + (i + 0.47) / 8 * box.size().z);
  }
  return heights;
}

void expect_areas(const std::vector<double>& found,
                  const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i], expected[i], 1e-6 * (1 + expected[i])) << i;
  }
}

// `red` and `blue` are what of the design has these colors.
void expect_colors(const std::string& design, const std::string& red,
                   const std::string& blue) {
  SCOPED_TRACE(design);
  const std::vector<double> heights = heights_of(design);
  const Areas areas = colored_areas(design, heights);
  for (const auto& [color, alone] :
       {std::pair(kRed, red), std::pair(kBlue, blue)}) {
    const auto found = areas.find(color);
    if (alone.empty()) {
      EXPECT_EQ(found, areas.end());
    } else {
      ASSERT_NE(found, areas.end());
      expect_areas(found->second, areas_of(alone, heights));
    }
  }
}

struct Parts {
  std::string a, b, c;
};

class Colors : public testing::TestWithParam<int> {
 protected:
  Parts parts() const {
    const auto seed = static_cast<std::uint32_t>(3 * GetParam());
    const auto part = [&](std::uint32_t i) {
      return "{" +
             support::random_design(support::RandomKind::kGeneric, seed + i,
                                    4) +
             " cube(2, center = true);}";
    };
    return {part(0), part(1), part(2)};
  }
};

std::string text(fmt::string_view format, const Parts& parts) {
  return fmt::format(fmt::runtime(format), fmt::arg("a", "union()" + parts.a),
                     fmt::arg("b", "union()" + parts.b),
                     fmt::arg("c", "union()" + parts.c));
}

TEST_P(Colors, AreOfWhatTheirLeavesMakeSolid) {
  const Parts p = parts();
  // What only unions have changed.
  expect_colors(text(R"(color("red") {a} color("blue") {b} {c})", p),
                text("{a}", p), text("{b}", p));
  // The outer color counts; one that cannot be read does not.
  expect_colors(
      text(R"(color("red") color("blue") {a} color([0, 0, 1]) {b} {c})", p),
      text("{a}", p), text("{b}", p));
  // What is subtracted gives no color.
  expect_colors(text(R"(difference() {{
                union() {{ color("red") {a} color("blue") {b} }}
                color("green") {c}
              }})",
                     p),
                text("difference() {{ {a} {c} }}", p),
                text("difference() {{ {b} {c} }}", p));
  // An intersection has one color, that of the first that has one.
  expect_colors(
      text(R"(color("red") {c} intersection() {{ {a} color("blue") {b} }})", p),
      text("{c}", p), text("intersection() {{ {a} {b} }}", p));
  expect_colors(
      text(R"(intersection() {{ color("red") {a} color("blue") {b} }} {c})", p),
      text("intersection() {{ {a} {b} }}", p), "");
  // Below an operator that makes one leaf the color is the operator's.
  expect_colors(
      text(R"(color("blue") hull() color("red") {a} {c} color("red") {b})", p),
      text("{b}", p), text("hull() {a}", p));
}

INSTANTIATE_TEST_SUITE_P(Random, Colors, testing::Range(0, 20));

TEST(Colors, AreOnlyMadeWhereAskedFor) {
  for (const Layer& layer : support::slice_layers(
           Design::from_text("color(\"red\") cube(3);").scene(),
           settings_at({1}))) {
    EXPECT_TRUE(layer.colored.empty());
  }
  EXPECT_TRUE(colored_areas("cube(3);", {1}).empty());
  EXPECT_TRUE(colored_areas("color(\"no color\") cube(3);", {1}).empty());
}

}  // namespace
}  // namespace lamina::slicer
