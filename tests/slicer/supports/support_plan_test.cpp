// Supports: laws that their layers keep, whatever the part is.

#include "slicer/supports/support_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
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
      if (support.end == SupportEnd::kPart) add(support.path.back(), 1);
    }
    return area;
  }

  SupportPlan plan;
  std::string lines;
  PrintCheck print;
  std::vector<std::pair<double, double>> common;  // height, area in both
};

// may_leave  whether a place may be left without a support, if that is said
void expect_lawful(const Supported& made, bool may_leave = false) {
  const double tip = made.plan.sizes.tip;
  for (const auto& [z, area] : made.common) {
    EXPECT_LE(area, made.allowed_at(z, tip) + 1e-6) << "at z " << z;
  }
  if (may_leave && !made.plan.unheld.empty()) return;
  EXPECT_TRUE(made.plan.unheld.empty());
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
    EXPECT_NE(support.end, SupportEnd::kPart);
    if (support.end != SupportEnd::kFoot) continue;
    EXPECT_NEAR(support.path.back().z,
                table.plan.bed + table.plan.sizes.foot_height, 1e-9);
  }
  // A shelf in a box has nothing but the box below it.
  const Supported box(
      "difference() { cube(30); translate([1, 1, 1]) cube([28, 28, 28]); } "
      "translate([0, 10, 15]) cube([25, 10, 1]);");
  EXPECT_GT(box.plan.count_on_part(), 0U);
  expect_lawful(box);
}

SupportPlan plan_of(const std::string& text, const SupportSizes& sizes = {}) {
  Settings settings;
  settings.layer_thickness = kThickness;
  const Design part = Design::from_text(text);
  return plan_supports(support::slice_layers(part.scene(), settings), sizes);
}

// The greatest distance from an image of a place on a support, turned about
// the origin and then mirrored in the x axis if asked, to the like place of
// another support.
double asymmetry(const SupportPlan& plan, double angle, bool is_mirrored) {
  const auto image = [&](Vec3 place) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const double y = s * place.x + c * place.y;
    return Vec3(c * place.x - s * place.y, is_mirrored ? -y : y, place.z);
  };
  double greatest = 0;
  for (const Support& support : plan.supports) {
    double nearest = 1e300;
    for (const Support& other : plan.supports) {
      if (other.path.size() != support.path.size()) continue;
      double farthest = 0;
      for (std::size_t i = 0; i < support.path.size(); ++i) {
        farthest = std::max(
            farthest, glm::distance(image(support.path[i]), other.path[i]));
      }
      nearest = std::min(nearest, farthest);
    }
    greatest = std::max(greatest, nearest);
  }
  return greatest;
}

TEST(Supports, AreAsSymmetricAsThePart) {
  struct Case {
    std::string part;
    int turns;
    bool has_mirror;
  };
  const std::string arm =
      "translate([0, -1, 8]) cube([12, 2, 2]); "
      "translate([9, -3, 6]) cube([2, 6, 2]);";
  const std::string bent =
      "translate([0, -1, 8]) cube([12, 2, 2]); "
      "translate([9, 0, 6]) cube([2, 6, 2]);";
  const std::string post = "cylinder(r = 2, h = 10, $fn = 60); ";
  const std::string dome =
      "difference() { sphere(9, $fn = 48); translate([0, 0, -3]) "
      "cube(12, center = true); }";
  for (const Case& one : {
           Case{post + "for (a = [0 : 90 : 270]) rotate(a) { " + arm + " }", 4,
                true},
           Case{post + "for (a = [0 : 120 : 240]) rotate(a) { " + bent + " }",
                3, false},
           Case{post + "for (a = [0 : 72 : 288]) rotate(a) { " + arm + " }", 5,
                true},
           Case{post + "for (a = [0 : 60 : 300]) rotate(a) { " + bent + " }", 6,
                false},
           Case{"cube([20, 20, 3], center = true);", 4, true},
           Case{"cube([30, 9, 3], center = true);", 2, true},
           Case{dome, 4, true},
       }) {
    SCOPED_TRACE(one.part);
    const SupportPlan plan = plan_of(one.part);
    EXPECT_FALSE(plan.supports.empty());
    EXPECT_TRUE(plan.unheld.empty());
    for (int k = 1; k < one.turns; ++k) {
      EXPECT_LT(asymmetry(plan, 2 * std::numbers::pi * k / one.turns, false),
                1e-3);
    }
    if (one.has_mirror) {
      EXPECT_LT(asymmetry(plan, 0, true), 1e-3);
    }
  }
}

// All corners of its layers lie on it when it is turned by 90°, but it is not.
TEST(Supports, AreNotMoreSymmetricThanThePart) {
  const SupportPlan plan = plan_of(
      "difference() { cube(20, center = true); cube([16, 22, 16], "
      "center = true); }");
  EXPECT_TRUE(plan.unheld.empty());
  EXPECT_LT(asymmetry(plan, std::numbers::pi, false), 1e-3);
  for (const Support& support : plan.supports) {
    const bool is_inside = support.contact.z > -9.9;
    if (is_inside) {
      EXPECT_LT(std::abs(support.contact.x), 8);
    }
  }
}

TEST(Supports, AreTiedToTheirNeighboursWhereTheyAreTall) {
  const std::string table =
      "translate([0, 0, 40]) cube([14, 14, 2]); cube([2, 2, 41]);";
  const Supported tall(table);
  EXPECT_FALSE(tall.plan.braces.empty());
  for (const auto& [from, to] : tall.plan.braces) {
    EXPECT_NEAR(glm::distance(Vec2(from), Vec2(to)), from.z - to.z, 1e-6);
    EXPECT_LE(from.z - to.z, 10);
  }
  expect_lawful(tall);
  EXPECT_TRUE(
      plan_of("translate([0, 0, 6]) cube([14, 14, 2]); cube([2, 2, 7]);")
          .braces.empty());
}

TEST(Supports, BeginAboveALayerThatIsEmpty) {
  expect_lawful(Supported("cube(3); translate([0, 0, 6]) cube([10, 10, 1]);"));
}

// Each part is held by itself, and nothing twice.
TEST(Supports, HoldPartsWithinEachOther) {
  const SupportPlan plan = plan_of(
      "for (r = [10, 20]) difference() { cylinder(r = r, h = 3, $fn = 40); "
      "translate([0, 0, -1]) cylinder(r = r - 2, h = 5, $fn = 40); }",
      {.tip = 0.4});
  EXPECT_TRUE(plan.unheld.empty());
  EXPECT_TRUE(plan.unwanted.empty());
  EXPECT_LE(plan.supports.size(), 64U);
  for (const Support& support : plan.supports) {
    for (const Support& other : plan.supports) {
      if (&support == &other) continue;
      EXPECT_GT(glm::distance(support.contact, other.contact), 0.4);
    }
  }
}

TEST(Supports, GoNoDeeperThanHalfOfThePart) {
  for (const char* const part :
       {"cube([6, 6, 0.2]);", "cube([6, 6, 0.1]);",
        "translate([0, 0, 8]) rotate([0, 30, 0]) cube([8, 8, 0.2]);"}) {
    SCOPED_TRACE(part);
    const Supported made(part);
    for (const Support& support : made.plan.supports) {
      EXPECT_LE(support.depth, 0.12);
    }
    expect_lawful(made);
  }
}

// A ring that stands up: below its outer side heads lean outwards.
TEST(Supports, LeanToWhereTheSurfaceFaces) {
  const SupportPlan plan = plan_of(
      "rotate([90, 0, 0]) rotate_extrude($fn = 72) translate([5, 0]) "
      "circle(1, $fn = 24);");
  for (const Support& support : plan.supports) {
    if (support.contact.z > -3 || std::abs(support.contact.x) < 1) continue;
    const double outwards =
        std::abs(support.path[1].x) - std::abs(support.contact.x);
    EXPECT_GT(outwards, 0) << support.contact.x;
  }
}

TEST(Supports, HoldABarAtBothEnds) {
  const SupportPlan plan =
      plan_of("rotate(20) cube([3.6, 0.8, 2], center = true);");
  ASSERT_EQ(plan.supports.size(), 2U);
  for (const Support& support : plan.supports) {
    EXPECT_NEAR(glm::length(Vec2(support.contact)), 0.9, 0.05);
  }
}

// What two pillars take is more than a branch and a trunk.
TEST(Supports, MergeToTreesWhereThatSavesResin) {
  const std::string bars =
      "translate([0, 0, 30]) { cube([9, 1, 1]); translate([0, 4, 0]) "
      "cube([9, 1, 1]); cube([1, 5, 1]); } cube([1, 1, 30]);";
  const Supported made(bars);
  std::size_t branches = 0;
  for (const Support& support : made.plan.supports) {
    if (support.end != SupportEnd::kPillar) continue;
    ++branches;
    const Vec3 joint = support.path.back();
    const Vec3 top = support.path[support.path.size() - 2];
    EXPECT_NEAR(glm::distance(Vec2(joint), Vec2(top)), top.z - joint.z, 1e-6);
    EXPECT_TRUE(
        std::ranges::any_of(made.plan.supports, [&](const Support& other) {
          return other.end == SupportEnd::kFoot &&
                 glm::distance(Vec2(other.path.back()), Vec2(joint)) < 1e-6 &&
                 other.path[other.path.size() - 2].z >= joint.z - 1e-6;
        }));
  }
  EXPECT_GT(branches, 0U);
  expect_lawful(made);
}

TEST(Supports, StandOnOneRaftIfAsked) {
  const Supported made("translate([0, 0, 8]) cube([14, 14, 2]);",
                       {.has_raft = true});
  expect_lawful(made);
  EXPECT_EQ(made.print.count(FindingKind::kSuctionCup), 0U);
  const Design whole =
      Design::from_text("translate([0, 0, 8]) cube([14, 14, 2]);" + made.lines);
  const auto first =
      support::slice_heights(whole.scene(), {made.plan.bed + 0.5});
  EXPECT_EQ(first[0].contours.loop_count(), 1U);
}

TEST(Supports, LeaveThePartItsLayers) {
  // 5 mm are no whole number of layers.
  Settings settings;
  settings.layer_thickness = 0.03;
  const Design part = Design::from_text("translate([0, 0, 2]) sphere(4);");
  const auto layers = support::slice_layers(part.scene(), settings);
  const SupportPlan plan = plan_supports(layers, {});
  const double lift = (layers.front().bottom - plan.bed) / 0.03;
  EXPECT_NEAR(lift, std::round(lift), 1e-6);
  EXPECT_GE(lift * 0.03, 5 - 1e-9);
  EXPECT_LT(lift * 0.03, 5.03);
}

TEST(Supports, AreWhereTheDesignWantsThem) {
  const std::string shelf = "translate([0, 0, 8]) cube([30, 6, 1]);";
  Settings settings;
  settings.layer_thickness = kThickness;
  const Design part = Design::from_text(shelf);
  const auto layers = support::slice_layers(part.scene(), settings);
  std::vector<double> heights;
  for (const Layer& layer : layers) heights.push_back(layer.section_z);
  const auto marked = [&](double tip, const std::string& text) {
    const Design leaf = Design::from_text(text);
    return MarkedSolid{tip, support::slice_heights(leaf.scene(), heights)};
  };
  const std::vector<MarkedSolid> marks = {
      marked(0, "translate([0, 0, 8]) cube([1.2, 6, 1]);"),
      marked(0.5, "translate([20, 0, 8]) cube([10, 6, 1]);")};
  const SupportPlan plan = plan_supports(layers, {}, marks);
  EXPECT_TRUE(plan.unwanted.empty());
  for (const Support& support : plan.supports) {
    EXPECT_GT(support.contact.x, 1.2);
    EXPECT_EQ(support.tip, support.contact.x > 19.98 ? 0.5 : 0.3);
  }
  // A light tip holds less than those beside it.
  const std::vector<MarkedSolid> light = {
      marked(0.15, "translate([0, 0, 8]) cube([15, 6, 1]);")};
  EXPECT_TRUE(plan_supports(layers, {.tip = 0.4}, light).unwanted.empty());
  // Where nothing near may hold it, that is said.
  const std::vector<MarkedSolid> none = {marked(0, shelf)};
  const SupportPlan without = plan_supports(layers, {}, none);
  EXPECT_TRUE(without.supports.empty());
  EXPECT_EQ(without.unwanted.size(), 1U);
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
    expect_lawful(Supported(part), true);
  }
}

}  // namespace
}  // namespace lamina::slicer
