// What must hold between the layers of different designs: moved ones, mirrored
// ones, reordered ones, and the laws of sets.

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/contour_checks.h"
#include "tests/support/design.h"

namespace lamina {
namespace {

using plane::Contours;
using support::Design;

// Coordinates are computed in another order: some roundings apart.
constexpr double kRounding = 1e-11;

// Where chains cross at a slope their crossing is found within a column of
// 1e-9 mm, and samples tie within 1e-6 mm.
constexpr double kTie = 2e-6;

const std::vector<double> kHeights = {0.37, 1.21, 2.05, 3.13, 4.49};

// A plate with a bore, a slanted peg, a ball and a block with a sharp edge.
const std::string kPart =
    "difference() { union() {"
    "  cube([9, 7, 2]);"
    "  translate([7, 5, 1]) rotate([20, 10, 0])"
    "    cylinder(r1 = 2, r2 = 1, h = 5, $fn = 17);"
    "  translate([2, 5, 2]) sphere(r = 2.3, $fn = 23);"
    "  translate([4, 1, 0]) linear_extrude(height = 5, scale = 0.5)"
    "    polygon([[0, 0], [3, 0.3], [0.4, 1.9]]);"
    "} translate([3, 3, -1]) cylinder(r = 1.1, h = 9, $fn = 31);"
    "  translate([6, -1, 1]) rotate([0, 30, 0]) cube([1.5, 9, 1.1]); }";

std::vector<Contours> sections(const std::string& text,
                               const std::vector<double>& heights = kHeights,
                               double pitch = 0) {
  const Design design = Design::from_text(text);
  std::vector<Contours> all;
  for (const auto& layer :
       support::slice_heights(design.scene(), heights, pitch)) {
    EXPECT_TRUE(support::are_sound(layer.contours)) << text << layer.section_z;
    all.push_back(layer.contours);
  }
  EXPECT_EQ(all.size(), heights.size());
  return all;
}

// The same loops in the same number, nowhere further apart than `distance`.
void expect_equal(const Contours& expected, const Contours& actual,
                  double distance) {
  EXPECT_EQ(support::count_loops(actual), support::count_loops(expected));
  EXPECT_LE(support::greatest_distance(expected, actual), distance);
  EXPECT_NEAR(support::total_area(actual), support::total_area(expected),
              distance * (support::total_perimeter(expected) + 1));
}

void expect_equal(const std::vector<Contours>& expected,
                  const std::vector<Contours>& actual, double distance) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    SCOPED_TRACE("section " + std::to_string(i));
    expect_equal(expected[i], actual[i], distance);
  }
}

std::vector<Contours> mapped(std::vector<Contours> all,
                             const std::function<Vec2(Vec2)>& map) {
  for (Contours& contours : all) {
    for (Vec2& point : contours.points) point = map(point);
  }
  return all;
}

// A map that mirrors turns loops around.
std::vector<Contours> turned_around(const std::vector<Contours>& all) {
  std::vector<Contours> result;
  for (const Contours& contours : all) {
    result.emplace_back();
    for (std::size_t l = 0; l < contours.loop_count(); ++l) {
      const auto loop = contours.loop(l);
      support::add_loop(result.back(), {loop.rbegin(), loop.rend()});
    }
  }
  return result;
}

// `head { bodies }`, the bodies one after another.
std::string enclose(const std::string& head,
                    const std::vector<std::string>& bodies) {
  std::string text = head;
  text += " {";
  for (const std::string& body : bodies) text += body;
  text += "}";
  return text;
}

std::vector<double> shifted(std::vector<double> heights, double shift,
                            double factor = 1) {
  for (double& z : heights) z = factor * z + shift;
  return heights;
}

TEST(Laws, ATurnTurnsTheLayers) {
  const auto plain = sections(kPart);
  for (const double angle_deg : {90.0, 180.0, 37.0, -120.0, 0.001}) {
    const double angle = angle_deg * std::numbers::pi / 180;
    const auto expected = mapped(plain, [&](Vec2 p) -> Vec2 {
      return {std::cos(angle) * p.x - std::sin(angle) * p.y,
              std::sin(angle) * p.x + std::cos(angle) * p.y};
    });
    SCOPED_TRACE(angle_deg);
    expect_equal(
        expected,
        sections(enclose("rotate(" + std::to_string(angle_deg) + ")", {kPart})),
        kTie);
  }
}

TEST(Laws, AMirrorImageMirrorsTheLayers) {
  const auto plain = sections(kPart);
  expect_equal(turned_around(mapped(plain,
                                    [](Vec2 p) -> Vec2 {
                                      return {-p.x, p.y};
                                    })),
               sections(enclose("mirror([1, 0, 0])", {kPart})), kTie);
  expect_equal(turned_around(mapped(plain,
                                    [](Vec2 p) -> Vec2 {
                                      return {p.y, p.x};
                                    })),
               sections(enclose("mirror([1, -1, 0])", {kPart})), kTie);
}

TEST(Laws, AMirrorImageInZReversesTheLayers) {
  const auto plain = sections(kPart);
  std::vector<double> heights;
  for (auto z = kHeights.rbegin(); z != kHeights.rend(); ++z) {
    heights.push_back(-*z);
  }
  auto mirrored = sections(enclose("mirror([0, 0, 1])", {kPart}), heights);
  expect_equal(plain, {mirrored.rbegin(), mirrored.rend()}, kTie);
}

TEST(Laws, AShiftShiftsTheLayers) {
  const auto expected =
      mapped(sections(kPart), [](Vec2 p) { return p + Vec2(12.5, -3.25); });
  expect_equal(expected,
               sections(enclose("translate([12.5, -3.25, 7.125])", {kPart}),
                        shifted(kHeights, 7.125)),
               kTie);
}

TEST(Laws, AScaleScalesTheLayers) {
  for (const double factor : {0.125, 3.0}) {
    const auto expected =
        mapped(sections(kPart), [&](Vec2 p) { return factor * p; });
    expect_equal(
        expected,
        sections(enclose("scale(" + std::to_string(factor) + ")", {kPart}),
                 shifted(kHeights, 0, factor)),
        kTie * factor + kTie);
  }
}

TEST(Laws, PitchChangesNothing) {
  const auto expected = sections(kPart);
  for (const double pitch : {0.003, 0.02, 0.0762, 0.5, 3.0, 100.0}) {
    SCOPED_TRACE(pitch);
    expect_equal(expected, sections(kPart, kHeights, pitch), kRounding);
  }
}

TEST(Laws, ThreadsChangeNoBit) {
  const Design design = Design::from_text(kPart);
  slicer::Settings settings;
  settings.layer_thickness = 0.02;
  settings.threads = 1;
  const auto expected = support::slice_layers(design.scene(), settings);
  settings.threads = 3;
  const auto actual = support::slice_layers(design.scene(), settings);
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < actual.size(); ++i) {
    EXPECT_EQ(actual[i].section_z, expected[i].section_z);
    EXPECT_EQ(actual[i].contours.ends, expected[i].contours.ends);
    EXPECT_TRUE(actual[i].contours.points == expected[i].contours.points);
  }
}

TEST(Laws, ToleranceBoundsTheDistance) {
  const Design design = Design::from_text(kPart);
  slicer::Settings settings;
  settings.layer_thickness = 0.1;
  settings.tolerance = 0;
  const auto exact = support::slice_layers(design.scene(), settings);
  std::size_t points = 0;
  std::size_t exact_points = 0;
  for (const double tolerance : {0.0001, 0.001, 0.01}) {
    settings.tolerance = tolerance;
    const auto layers = support::slice_layers(design.scene(), settings);
    ASSERT_EQ(layers.size(), exact.size());
    for (std::size_t i = 0; i < layers.size(); ++i) {
      EXPECT_TRUE(support::are_sound(layers[i].contours));
      EXPECT_EQ(support::count_loops(layers[i].contours),
                support::count_loops(exact[i].contours));
      EXPECT_LE(
          support::greatest_distance(layers[i].contours, exact[i].contours),
          tolerance);
      points += layers[i].contours.points.size();
      exact_points += exact[i].contours.points.size();
    }
  }
  EXPECT_LE(points, exact_points);
}

TEST(Laws, OrderOfChildrenChangesNothing) {
  const std::string a = "cube([4, 4, 4]);";
  const std::string b = "translate([2, 2, 1]) sphere(r = 2.5, $fn = 20);";
  const std::string c =
      "translate([3, -1, 0]) cylinder(r = 2, h = 5, $fn = 9);";
  for (const std::string op : {"union()", "intersection()"}) {
    expect_equal(sections(enclose(op, {a, b, c})),
                 sections(enclose(op, {c, a, b})), kRounding);
  }
  expect_equal(sections(enclose("difference()", {a, b, c})),
               sections(enclose("difference()", {a, c, b})), kRounding);
}

TEST(Laws, AreasOfUnionAndIntersectionAddUp) {
  const std::string a = "rotate([10, 20, 30]) cube([6, 5, 9]);";
  const std::string b =
      "translate([2, 2, 0]) cylinder(r1 = 3, r2 = 1, h = 6, $fn = 40);";
  const auto both = sections(a + b);
  const auto common = sections(enclose("intersection()", {a, b}));
  const auto only_a = sections(a);
  const auto only_b = sections(b);
  const auto rest = sections(enclose("difference()", {a, b}));
  for (std::size_t i = 0; i < both.size(); ++i) {
    const double sum =
        support::total_area(only_a[i]) + support::total_area(only_b[i]);
    EXPECT_NEAR(support::total_area(both[i]) + support::total_area(common[i]),
                sum, 1e-9);
    EXPECT_NEAR(support::total_area(rest[i]) + support::total_area(common[i]),
                support::total_area(only_a[i]), 1e-9);
  }
}

TEST(Laws, DifferenceOfAUnionIsTheIntersectionOfDifferences) {
  const std::string a = "cube([6, 6, 5]);";
  const std::string b = "translate([1, 1, 0]) sphere(r = 3, $fn = 21);";
  const std::string c =
      "translate([4, 3, -1]) rotate([0, 15, 0]) cube([1, 9, 9]);";
  expect_equal(
      sections(enclose("difference()", {a, b, c})),
      sections(enclose("intersection()", {enclose("difference()", {a, b}),
                                          enclose("difference()", {a, c})})),
      kTie);
}

TEST(Laws, ASolidWithItselfIsItself) {
  const auto plain = sections(kPart);
  expect_equal(plain, sections(enclose("union()", {kPart, kPart})), kRounding);
  expect_equal(plain, sections(enclose("intersection()", {kPart, kPart})),
               kRounding);
  for (const Contours& contours :
       sections(enclose("difference()", {kPart, kPart}))) {
    EXPECT_TRUE(contours.is_empty());
  }
}

TEST(Laws, CutInTwoAndUnitedAgainIsTheSame) {
  const std::string half = "translate([4.3, -50, -50]) cube([100, 100, 100]);";
  expect_equal(
      sections(kPart),
      sections(enclose("union()", {enclose("difference()", {kPart, half}),
                                   enclose("intersection()", {kPart, half})})),
      kTie);
}

}  // namespace
}  // namespace lamina
