// Supports: laws that their layers keep, whatever the part is.

#include "slicer/supports/support_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "slicer/check/print/layer_graph.h"
#include "slicer/supports/support_text.h"
#include "tests/support/design.h"

namespace lamina::slicer {
namespace {

using support::Design;

constexpr double kThickness = 0.1;

double area_of(const plane::Contours& contours) {
  double twice = 0;
  for (std::size_t l = 0; l < contours.loop_count(); ++l) {
    const auto loop = contours.loop(l);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 a = loop[i];
      const Vec2 b = loop[(i + 1) % loop.size()];
      twice += a.x * b.y - a.y * b.x;
    }
  }
  return twice / 2;
}

// A part, its supports, and both together.
struct Supported {
  explicit Supported(const std::string& text, SupportSizes sizes = {}) {
    Settings settings;
    settings.layer_thickness = kThickness;
    const Design part = Design::from_text(text);
    plan = plan_supports(support::slice_layers(part.scene(), settings), sizes);
    lines = support_text(plan, Affine(1.0));
    const Design whole = Design::from_text(text + lines);
    const Design supports = Design::from_text(lines);
    LayerGraph graph({.self_supporting = hold_radius(sizes.tip, 0)});
    std::vector<double> heights;
    for (const Layer& layer : support::slice_layers(whole.scene(), settings)) {
      graph.take(layer, nullptr);
      heights.push_back(layer.section_z);
    }
    print = graph.finish();
    const auto all = support::slice_heights(whole.scene(), heights);
    const auto only_part = support::slice_heights(part.scene(), heights);
    const auto only_supports =
        support::slice_heights(supports.scene(), heights);
    for (std::size_t i = 0; i < heights.size(); ++i) {
      common.emplace_back(heights[i], area_of(only_part[i].contours) +
                                          area_of(only_supports[i].contours) -
                                          area_of(all[i].contours));
    }
  }

  // The area that all tips about a height may have in common with the part.
  double allowed_at(double z, double tip) const {
    double area = 0;
    const auto add = [&](Vec3 inside, double direction) {
      // From within the part to a tip's diameter away from it.
      const double off = direction * (z - inside.z);
      if (off > -1.5 * tip && off < 1.5 * tip + 0.2) {
        area += std::numbers::pi * tip * tip;
      }
    };
    for (const Support& support : plan.supports) {
      add(support.path.front(), -1);
      if (support.stands_on_part) add(support.path.back(), 1);
    }
    return area;
  }

  SupportPlan plan;
  std::string lines;
  PrintCheck print;
  std::vector<std::pair<double, double>> common;  // height, area in both
};

void expect_lawful(const Supported& made) {
  const double tip = made.plan.sizes.tip;
  for (const auto& [z, area] : made.common) {
    EXPECT_LE(area, made.allowed_at(z, tip) + 1e-6) << "at z " << z;
  }
  if (!made.plan.unheld.empty()) return;
  EXPECT_EQ(made.print.counts({FindingKind::kIsland, FindingKind::kLoosePart,
                               FindingKind::kOverhang}),
            "");
}

TEST(HoldRadius, IsThatOfTestPrintsAndGrowsWithTheTip) {
  EXPECT_DOUBLE_EQ(hold_radius(0.4, 0), 3.2);
  EXPECT_DOUBLE_EQ(hold_radius(0.4, 3.9), 4);
  EXPECT_DOUBLE_EQ(hold_radius(0.4, 9.45), 4.5);
  EXPECT_DOUBLE_EQ(hold_radius(0.4, 100), 6);
  EXPECT_DOUBLE_EQ(hold_radius(0.2, 0), 1.6);
}

TEST(Supports, HoldWhatHangs) {
  for (const char* const part : {
           "sphere(5, $fn = 60);",
           "cube([14, 10, 1]);",
           "translate([0, 0, 8]) cube([14, 14, 2]); "
           "translate([5, 5, 0]) cube([3, 3, 9]);",
           "rotate([90, 0, 0]) difference() { cylinder(r = 10, h = 6, "
           "center = true, $fn = 90); cylinder(r = 8.5, h = 7, center = true, "
           "$fn = 90); }",
           "translate([0, 0, 8]) cube([14, 14, 2]); "
           "translate([4, 4, 0]) cube([3, 3, 9]);",
           "difference() { cube(20); translate([2, -1, 2]) "
           "cube([16, 22, 16]); }",
       }) {
    SCOPED_TRACE(part);
    const Supported made(part);
    EXPECT_FALSE(made.plan.supports.empty());
    EXPECT_TRUE(made.plan.unheld.empty());
    expect_lawful(made);
  }
}

TEST(Supports, StandOnTheBedWhereTheyCan) {
  const Supported table(
      "translate([0, 0, 8]) cube([14, 14, 2]); cube([3, 3, 9]);");
  for (const Support& support : table.plan.supports) {
    EXPECT_FALSE(support.stands_on_part);
    EXPECT_NEAR(support.path.back().z,
                table.plan.bed + table.plan.sizes.foot_height, 1e-9);
  }
  // A shelf in a box has nothing but the box below it.
  const Supported box(
      "difference() { cube(30); translate([1, 1, 1]) cube([28, 28, 28]); } "
      "translate([0, 10, 15]) cube([25, 10, 1]);");
  EXPECT_TRUE(std::ranges::any_of(box.plan.supports, &Support::stands_on_part));
  expect_lawful(box);
}

TEST(Supports, AreTheSameForAPartThatIsShifted) {
  const std::string part = "rotate([0, 30, 0]) cube([12, 6, 4]);";
  const Supported here(part);
  const Supported there("translate([8, -4, 2]) " + part);
  ASSERT_EQ(here.plan.supports.size(), there.plan.supports.size());
  for (std::size_t i = 0; i < here.plan.supports.size(); ++i) {
    const Vec3 shift = there.plan.supports[i].contact -
                       here.plan.supports[i].contact - Vec3(8, -4, 2);
    EXPECT_LT(std::abs(shift.x) + std::abs(shift.y) + std::abs(shift.z), 1e-6);
  }
}

TEST(Supports, KeepTheLawsOfRandomParts) {
  std::mt19937 random(20261127);
  const auto number = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int i = 0; i < 60; ++i) {
    std::string part = "cube([4, 4, 12]);";
    for (int k = 0; k < 4; ++k) {
      part += fmt::format(
          "translate([{:.2f}, {:.2f}, {:.2f}]) rotate([{:.0f}, {:.0f}, 0]) ",
          number(-4, 6), number(-4, 6), number(0, 14), number(0, 90),
          number(0, 90));
      part += k % 2 == 0
                  ? fmt::format("cube([{:.2f}, {:.2f}, {:.2f}]);", number(1, 9),
                                number(1, 6), number(0.5, 3))
                  : fmt::format(
                        "cylinder(r = {:.2f}, h = {:.2f}, "
                        "$fn = 24);",
                        number(0.5, 3), number(1, 8));
    }
    SCOPED_TRACE(part);
    expect_lawful(Supported(part));
  }
}

}  // namespace
}  // namespace lamina::slicer
