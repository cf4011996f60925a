// roof() against the distance from its drawing's outline, closed formulas, and
// outlines that move inwards in small steps.

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "plane/region/offset.h"
#include "plane/region/region.h"
#include "tests/support/contour_checks.h"
#include "tests/support/design.h"

namespace lamina {
namespace {

using plane::Contours;
using plane::Region;
using support::Design;

constexpr auto kAngle = "polygon([[0,0],[9,0],[9,3],[4,3],[4,8],[0,8]]);";
constexpr auto kCross =
    "square([12, 4], center = true); square([4, 12], center = true);";
constexpr auto kFrame =
    "difference() { square(10); translate([3, 2.5]) square([3, 5]); }";
constexpr auto kStar =
    "polygon([for (i = [0:17]) (i % 2 == 0 ? 10 : 4 + i / 6) * "
    "[cos(20 * i), sin(20 * i)]]);";
constexpr auto kWasher =
    "difference() { circle(9, $fn = 24); circle(4, $fn = 15); "
    "translate([6, 0]) square(3, center = true); }";
// Its edges are short against its depth, and corners of holes in a column meet.
constexpr auto kHoles =
    "difference() { square(14); for (x = [2, 4, 6, 9], y = [3, 5, 8]) "
    "translate([x, y + x / 9]) circle(0.4, $fn = 16); }";
constexpr std::array kDrawings = {kAngle, kCross,  kFrame,
                                  kStar,  kWasher, kHoles};

Contours section(const std::string& text, double z) {
  const Design design = Design::from_text(text);
  const auto layers = support::slice_heights(design.scene(), {z});
  EXPECT_TRUE(support::are_sound(layers.at(0).contours)) << text;
  return layers.at(0).contours;
}

Contours drawing(const std::string& text) {
  return section("linear_extrude(2) { " + text + " }", 1);
}

std::string straight(const std::string& text) {
  return "roof(method = \"straight\") { " + text + " }";
}

double volume(const std::string& text, double top) {
  constexpr int kLayers = 400;
  const Design design = Design::from_text(text);
  std::vector<double> heights;
  for (int i = 0; i < kLayers; ++i)
    heights.push_back(top * (i + 0.5) / kLayers);
  double sum = 0;
  for (const auto& layer : support::slice_heights(design.scene(), heights)) {
    sum += support::total_area(layer.contours);
  }
  return sum * top / kLayers;
}

// The outline after moving inwards by z, in small steps with sharp joins.
double stepped_area(const std::string& text, double z) {
  constexpr int kSteps = 400;
  Region region = plane::to_region(drawing(text));
  for (int i = 0; i < kSteps; ++i) {
    region = plane::offset(region, -z / kSteps, plane::Join::kMiter, 1);
  }
  return plane::area(region);
}

TEST(Roof, OfAConvexDrawingIsAHippedRoof) {
  // Over 10 x 4 a ridge of 6: three prisms' and one pyramid's volume.
  for (const std::string method : {"voronoi", "straight"}) {
    EXPECT_NEAR(volume("roof(method = \"" + method + "\") square([10, 4]);", 2),
                104.0 / 3, 1e-3)
        << method;
  }
  EXPECT_NEAR(volume("roof() square(2);", 1), 4.0 / 3, 1e-4);
}

// Its greatest depth is that which area and border give.
TEST(Roof, OfATurnedDrawingIsThatOfTheDrawing) {
  struct Case {
    std::string text;
    double volume = 0;
  };
  const std::array cases = {
      Case{"square(2, center = true);", 4.0 / 3},
      Case{"square([10, 2], center = true);", 10 - 2.0 / 3},
      Case{"polygon([[-1, -1], [3, -1], [-1, 2]]);", 2.0},
      Case{"circle(1 / cos(30), $fn = 6);", 2 / std::sqrt(3.0)}};
  for (int degrees = 0; degrees < 360; degrees += 7) {
    for (const Case& c : cases) {
      const std::string drawing =
          fmt::format("translate([3, 1]) rotate({}) {}", degrees, c.text);
      for (const std::string method : {"voronoi", "straight"}) {
        EXPECT_NEAR(volume("roof(method = \"" + method + "\") " + drawing, 1),
                    c.volume, 1e-4 * c.volume)
            << method << " " << drawing;
      }
    }
  }
}

TEST(Roof, StraightMeetsClosedFormulas) {
  EXPECT_NEAR(volume(straight("square([10, 3]); square([3, 10]);"), 1.5), 36,
              1e-3);
  EXPECT_NEAR(volume(straight(kCross), 2), 224.0 / 3, 1e-3);
}

TEST(Roof, StraightIsTheOutlineMovedInwardsStepByStep) {
  for (const std::string text : kDrawings) {
    for (const double z : {0.1, 0.6, 1.1, 1.4, 1.9, 2.3}) {
      const double expected = stepped_area(text, z);
      EXPECT_NEAR(support::total_area(section(straight(text), z)), expected,
                  0.005 + 0.005 * expected)
          << text << " at " << z;
    }
  }
}

TEST(Roof, StraightOfRandomDrawingsIsTheOutlineMovedInwards) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> radius(2, 10);
  for (int design = 0; design < 40; ++design) {
    const int n = 5 + design % 12;
    std::string points;
    for (int i = 0; i < n; ++i) {
      points += fmt::format("{}*[cos({}),sin({})],", radius(random),
                            360.0 * i / n, 360.0 * i / n);
    }
    const std::string text = "polygon([" + points + "]);";
    for (const double z : {0.3, 0.9, 1.5, 2.1}) {
      const double expected = stepped_area(text, z);
      EXPECT_NEAR(support::total_area(section(straight(text), z)), expected,
                  0.01 + 0.005 * expected)
          << text << " at " << z;
    }
  }
}

TEST(Roof, ReflexCornersThatMeetGoOnAsOne) {
  const std::string text =
      "polygon([[-10,0],[-5,0],[-1,5],[-4,0],[4,0],[1,5],[5,0],[10,0],"
      "[10,20],[-10,20]]);";
  for (const double z : {0.6, 1.2, 3.0}) {
    // Where the outer edges' lines, z further inwards, meet.
    const Vec2 peak(0, (25 + z * std::sqrt(41)) / 4);
    const Contours contours = section(straight(text), z);
    EXPECT_NEAR(support::distance_to_edges(contours, peak), 0, 1e-9) << z;
    EXPECT_GT(support::distance_to_edges(contours, peak + Vec2(0, 0.01)), 1e-3)
        << z;
  }
}

// All lines of its outline are at one distance from the middle, so what is left
// shrinks towards it, and is gone long before a circle moved inwards would be.
TEST(Roof, StraightOfAStarOfManyCornersShrinks) {
  const std::string star =
      "polygon([for (i = [0:999]) (10 + i % 2) * "
      "[cos(i * 0.36), sin(i * 0.36)]]);";
  const double a = std::numbers::pi / 500;
  const double tip = 11 - 10 * std::cos(a);
  const double notch = 10 * std::sin(a);
  const double distance = 11 * notch / std::hypot(tip, notch);
  const double area = 500 * 11 * notch;
  const double z = distance * 0.75;
  EXPECT_NEAR(support::total_area(section(straight(star), z)), area / 16,
              area * 1e-6);
  const Design roof = Design::from_text(straight(star));
  EXPECT_NEAR(roof.scene().box.high.z, distance, distance * 3e-5);
}

TEST(Roof, HasTheSameVolumeOnItsSide) {
  for (const std::string text : kDrawings) {
    for (const std::string& roof :
         {"roof() { " + text + " }", straight(text)}) {
      const double expected = volume(roof, 6);
      EXPECT_NEAR(
          volume("translate([0, 0, 14]) rotate([90, 0, 0]) " + roof, 28),
          expected, 1e-3 * expected)
          << roof;
    }
  }
}

TEST(Roof, VoronoiIsWhereTheOutlineIsFartherThanTheHeight) {
  for (const std::string text : kDrawings) {
    const Contours outline = drawing(text);
    for (const double z : {0.2, 0.8, 1.3, 1.8}) {
      const Contours roof = section("roof($fn = 720) { " + text + " }", z);
      const double left = plane::area(plane::offset(
          plane::to_region(outline), -z, plane::Join::kRound, 1e-5));
      EXPECT_NEAR(support::total_area(roof), left, 1e-3) << text;
      for (std::size_t l = 0; l < roof.loop_count(); ++l) {
        for (const Vec2 p : roof.loop(l)) {
          EXPECT_NEAR(support::distance_to_edges(outline, p), z, 1e-4 * z)
              << text;
        }
      }
    }
  }
}

TEST(Roof, OfTextHasOneTopForEachLetter) {
  const std::string text = "text(\"Roof\", size = 10);";
  for (const std::string roof : {"roof() ", "roof(method = \"straight\") "}) {
    const double before = support::total_area(drawing(text));
    const Contours contours = section(roof + text, 0.3);
    EXPECT_LT(support::total_area(contours), before);
    EXPECT_EQ(contours.loop_count(), drawing(text).loop_count());
  }
}

TEST(Roof, TakesTheMethodsOfOpenScad) {
  const Design design = Design::from_text("roof(method = \"x\") square(3);");
  const auto layers = support::slice_heights(design.scene(), {0.5});
  EXPECT_DOUBLE_EQ(support::total_area(layers.at(0).contours), 4);
}

}  // namespace
}  // namespace lamina
