// What the layer graph finds, against shapes of which everybody knows what
// goes wrong, laws, and a flood fill of pixels.
//
// LAMINA_GRAPH_TRIALS says how many random designs of each kind are judged,
// LAMINA_GRAPH_SEED where to begin.

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "slicer/check/print/layer_graph.h"
#include "slicer/slice/slice.h"
#include "tests/slices/pixel_graph.h"
#include "tests/support/design.h"
#include "tests/support/environment.h"
#include "tests/support/random_design.h"

namespace lamina {
namespace {

using slicer::Finding;
using slicer::FindingKind;
using slicer::PrintCheck;

constexpr double kPi = std::numbers::pi;

struct Sliced {
  std::vector<slicer::Layer> layers;
  PrintCheck print;
};

Sliced slice(const std::string& text, double thickness = 0.1,
             double self_supporting = 0) {
  const support::Design design = support::Design::from_text(text);
  slicer::Settings settings;
  settings.layer_thickness = thickness;
  settings.print.self_supporting = self_supporting;
  settings.finds_makers = true;
  support::LayerList list;
  Diagnostics diagnostics;
  const auto report = slicer::slice(
      design.scene(), slicer::plan_layers(design.scene(), settings), settings,
      list, diagnostics);
  return {list.layers, *report.print};
}

PrintCheck check(const std::string& text, double thickness = 0.1,
                 double self_supporting = 0) {
  return slice(text, thickness, self_supporting).print;
}

// "1 island, 2 overhangs": all that matters.
std::string counts(const PrintCheck& print) {
  std::string text;
  for (std::size_t i = 0; i < slicer::kFindingKinds; ++i) {
    const auto kind = static_cast<FindingKind>(i);
    if (const std::size_t count = print.count(kind)) {
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count,
                          slicer::name_of(kind));
    }
  }
  return text;
}

const Finding& only(const PrintCheck& print, FindingKind kind) {
  const auto found =
      std::ranges::find_if(print.findings, [kind](const Finding& finding) {
        return finding.kind == kind && !finding.is_minor;
      });
  EXPECT_NE(found, print.findings.end());
  return *found;
}

TEST(PrintCheck, FindsNothingInACube) {
  const PrintCheck print = check("cube(10);");
  EXPECT_TRUE(print.findings.empty());
  EXPECT_DOUBLE_EQ(print.peel.greatest_area, 100);
  EXPECT_EQ(print.peel.layer, 1U);
  EXPECT_EQ(print.peel.jump_layer, 0U);
}

TEST(PrintCheck, FindsAFloatingCube) {
  const PrintCheck print = check("cube(10); translate([20, 0, 5]) cube(4);");
  EXPECT_EQ(counts(print), "1 loose part");
  const Finding& part = only(print, FindingKind::kLoosePart);
  EXPECT_EQ(part.first_layer, 51U);
  EXPECT_EQ(part.last_layer, 90U);
  EXPECT_NEAR(part.area, 16, 1e-9);
  EXPECT_NEAR(part.place.x, 22, 0.3);
  EXPECT_NEAR(part.place.y, 2, 0.3);
  EXPECT_EQ(part.instance, 1U);
  EXPECT_NEAR(part.volume, 64, 1e-9);
  EXPECT_NEAR(part.box.low.z, 5, 1e-9);
  EXPECT_NEAR(part.box.high.z, 9, 1e-9);
  EXPECT_NEAR(print.peel.greatest_jump, 16, 1e-9);
  EXPECT_EQ(print.peel.jump_layer, 51U);
}

TEST(PrintCheck, SaysWhereAnIslandIsJoined) {
  // A table upside down hangs one leg lower than the others.
  const PrintCheck print = check(
      "translate([0, 0, 8]) cube([30, 10, 2]); cube([4, 10, 10]);"
      "translate([26, 3, 5]) cube([4, 4, 5]);");
  EXPECT_EQ(counts(print), "1 island, 1 overhang");
  const Finding& island = only(print, FindingKind::kIsland);
  EXPECT_EQ(island.first_layer, 51U);
  EXPECT_EQ(island.last_layer, 80U);
  EXPECT_TRUE(island.is_joined);
}

TEST(PrintCheck, FindsNoIslandInABallOnTheBed) {
  const PrintCheck print = check("sphere(5, $fn = 60);", 0.05);
  EXPECT_EQ(print.count(FindingKind::kIsland), 0U);
  // Below 45° the sphere hangs over: to (1 - 1/√2)·5 mm.
  const Finding& overhang = only(print, FindingKind::kOverhang);
  EXPECT_EQ(overhang.first_layer, 2U);
  EXPECT_NEAR(overhang.top, -5 / std::sqrt(2.0), 0.2);
}

TEST(PrintCheck, FindsNothingInABallOnAStickThatIsSteep) {
  EXPECT_EQ(counts(check("$fn = 50; cylinder(r = 1, h = 10);"
                         "translate([0, 0, 10])"
                         "cylinder(r1 = 1, r2 = 4, h = 3.5);")),
            "");
}

// Cavities that are open to the bed only are closed by the plate.
TEST(PrintCheck, FindsCups) {
  const std::string cup =
      "difference() { cylinder(r = 6, h = 10, $fn = 40);"
      "translate([0, 0, 2]) cylinder(r = 5, h = 10, $fn = 40); }";
  for (const std::string& text : {cup, "rotate([180, 0, 0]) " + cup}) {
    const PrintCheck print = check(text);
    EXPECT_EQ(print.count(FindingKind::kSuctionCup), 1U) << text;
    EXPECT_EQ(print.count(FindingKind::kResinTrap), 0U) << text;
    const Finding& found = only(print, FindingKind::kSuctionCup);
    const double area = 20 * 25 * std::sin(kPi / 20);
    EXPECT_NEAR(found.area, area, 0.05);
    EXPECT_NEAR(found.volume, 8 * area, 0.5);
    EXPECT_EQ(found.last_layer - found.first_layer + 1, 80U);
  }
}

TEST(PrintCheck, EndsACupWhereAHoleLeadsOut) {
  const PrintCheck print = check(
      "difference() { cylinder(r = 6, h = 10, $fn = 40);"
      "translate([0, 0, 2]) cylinder(r = 5, h = 10, $fn = 40);"
      "translate([0, 0, 3]) cube([10, 1, 1]); }");
  const Finding& cup = only(print, FindingKind::kSuctionCup);
  EXPECT_EQ(cup.first_layer, 21U);
  EXPECT_EQ(cup.last_layer, 30U);
}

TEST(PrintCheck, FindsTheTrapInAHollowBall) {
  const std::string ball =
      "difference() { sphere(6, $fn = 48); sphere(4, $fn = 48);";
  const PrintCheck closed = check(ball + "}");
  EXPECT_EQ(closed.count(FindingKind::kResinTrap), 1U);
  EXPECT_EQ(closed.count(FindingKind::kSuctionCup), 0U);
  EXPECT_NEAR(only(closed, FindingKind::kResinTrap).volume, 4.0 / 3 * kPi * 64,
              4);
  EXPECT_EQ(only(closed, FindingKind::kResinTrap).instance, 1U);
  // A hole at the bottom lets the resin out.
  const PrintCheck open =
      check(ball + "translate([0, 0, -8]) cylinder(h = 8, d = 2.5); }");
  EXPECT_EQ(open.count(FindingKind::kResinTrap), 0U);
}

TEST(PrintCheck, FindsTheCeilingOfAnArch) {
  const PrintCheck print = check(
      "difference() { cube([30, 5, 10]); translate([5, -1, -1])"
      "cube([20, 7, 6]); }");
  EXPECT_EQ(counts(print), "1 overhang");
  const Finding& overhang = only(print, FindingKind::kOverhang);
  EXPECT_EQ(overhang.first_layer, 51U);
  EXPECT_EQ(overhang.last_layer, 51U);
  EXPECT_NEAR(overhang.distance, 10, 0.5);
  EXPECT_NEAR(overhang.area, 100, 3);
  EXPECT_NEAR(overhang.place.x, 15, 1);
  EXPECT_EQ(overhang.instance, 1U);
}

TEST(PrintCheck, CountsTheTeethOfAComb) {
  const PrintCheck print = check(
      "translate([0, 0, 10]) cube([40, 4, 3]); cube([3, 4, 12]);"
      "for (i = [1 : 6]) translate([6 * i, 1, 4]) cube([2, 2, 7]);");
  EXPECT_EQ(print.count(FindingKind::kIsland), 6U);
  EXPECT_EQ(print.count(FindingKind::kLoosePart), 0U);
}

// A board on a post: all but what is within reach of the post hangs over.
TEST(PrintCheck, MeasuresAnOverhangWhateverTheReach) {
  const std::string board =
      "cube([4, 5, 5]); translate([0, 0, 5]) cube([12, 5, 1]);";
  for (const double reach : {0.15, 0.5, 2.0, 3.0}) {
    const Finding overhang =
        only(check(board, 0.1, reach), FindingKind::kOverhang);
    EXPECT_NEAR(overhang.area, (8 - reach) * 5, 0.05 * (8 - reach) * 5);
    EXPECT_NEAR(overhang.distance, 8, 1e-9);
    EXPECT_EQ(overhang.first_layer, 51U);
    EXPECT_EQ(overhang.last_layer, 51U);
  }
}

// Stairs: each layer stands out by tan(angle) of its height.
std::string stairs(double angle_deg, double thickness) {
  const double step = thickness * std::tan(angle_deg * kPi / 180);
  return fmt::format(
      "for (i = [0 : 40]) translate([0, 0, i * {0}]) cube([5 + i * {1}, 5, "
      "{0}]);",
      thickness, step);
}

TEST(PrintCheck, KnowsAStairOf44DegreesFromOneOf46) {
  for (const double thickness : {0.05, 0.1, 0.2}) {
    EXPECT_TRUE(check(stairs(44, thickness), thickness).findings.empty());
    EXPECT_TRUE(check(stairs(45, thickness), thickness).findings.empty());
    // Beyond 45° stands out no more than a hair.
    const PrintCheck steep = check(stairs(46, thickness), thickness);
    ASSERT_EQ(steep.findings.size(), 1U);
    EXPECT_EQ(steep.findings[0].kind, FindingKind::kOverhang);
    EXPECT_EQ(steep.findings[0].first_layer, 2U);
    EXPECT_EQ(steep.findings[0].last_layer, 41U);
    EXPECT_NEAR(steep.findings[0].distance,
                thickness * std::tan(46 * kPi / 180), 1e-9);
    const PrintCheck flat = check(stairs(60, thickness), thickness);
    EXPECT_EQ(counts(flat), "1 overhang");
    EXPECT_TRUE(check(stairs(60, thickness), thickness, 0.4).findings.empty());
  }
}

TEST(PrintCheck, FindsNothingInUprightAndRoundWalls) {
  EXPECT_EQ(counts(check("linear_extrude(20) offset(2) square([20, 5]);")), "");
  EXPECT_EQ(
      counts(check("cylinder(r1 = 5, r2 = 15, h = 10, $fn = 180);", 0.05)), "");
}

TEST(PrintCheck, TakesAContactThatIsNoneForNone) {
  // Upright walls that only touch, and a gap of a tenth of a micrometre.
  EXPECT_EQ(check("cube(5); translate([5, 0, 5]) cube(5);")
                .count(FindingKind::kLoosePart),
            1U);
  EXPECT_EQ(check("cube(5); translate([4.9, 0, 5]) cube(5);")
                .count(FindingKind::kLoosePart),
            0U);
}

// What is smaller than a pixel is minor, whatever it is.
TEST(PrintCheck, CountsWhatIsSmallerThanAPixelApart) {
  const std::string text =
      "cube(5); translate([8, 0, 2]) cube([0.04, 0.04, 1]);";
  EXPECT_EQ(counts(check(text)), "1 loose part");
  const support::Design design = support::Design::from_text(text);
  slicer::Settings settings;
  settings.print.least_area = 0.05 * 0.05;
  slicer::LayerDrain drain;
  Diagnostics diagnostics;
  const auto report = slicer::slice(
      design.scene(), slicer::plan_layers(design.scene(), settings), settings,
      drain, diagnostics);
  EXPECT_EQ(counts(*report.print), "");
  EXPECT_EQ(report.print->count_minor(), 1U);
}

TEST(PrintCheck, CountsStripsNarrowerThanHalfAPixelApart) {
  for (const auto& [width, kind] :
       {std::pair("0.01", ""), std::pair("0.03", "1 loose part")}) {
    const PrintCheck print = check("cube(5); translate([8, 0, 2]) cube([3, " +
                                   std::string(width) + ", 1]);");
    EXPECT_EQ(counts(print), kind) << width;
    EXPECT_EQ(print.findings.size(), 1U) << width;
  }
}

// Its lowest layer is smaller than a pixel, those above it are not.
TEST(PrintCheck, JudgesAnIslandByItsGreatestLayer) {
  const PrintCheck print = check(
      "cube([2, 2, 6]); translate([0, 0, 5]) cube([6, 2, 1]);"
      "translate([5, 1, 1]) cylinder(r1 = 0.001, r2 = 0.5, h = 4.5, $fn = "
      "30);");
  EXPECT_EQ(print.count(FindingKind::kIsland), 1U);
}

// What no contact is wide enough for holds no resin.
TEST(PrintCheck, PassesOverHollowsNarrowerThanAContact) {
  EXPECT_TRUE(check("difference() { cube(5); translate([1, 1, 1]) "
                    "cube([3, 0.0009, 3]); }")
                  .findings.empty());
}

// --- Laws -------------------------------------------------------------------

const char* const kFigure =
    "difference() { union() { cube([20, 12, 10]);"
    "translate([10, 6, 14]) sphere(4, $fn = 24);"
    "translate([2, 2, 9]) cube([2, 2, 9]); translate([2, 2, 17]) cube([14, 2, "
    "2]);"
    "translate([15, 2, 15]) cube([1, 1, 3]); }"
    "translate([5, 5, 3]) sphere(2, $fn = 24);"
    "translate([14, 6, -1]) cylinder(d = 3, h = 6); }";

std::string without_overhangs(PrintCheck print) {
  std::erase_if(print.findings, [](const Finding& finding) {
    return finding.kind == FindingKind::kOverhang;
  });
  return counts(print);
}

TEST(PrintCheck, KeepsItsFindingsWhereTheDesignIsMoved) {
  const std::string findings = without_overhangs(check(kFigure));
  EXPECT_EQ(findings, "1 island, 1 suction cup, 1 resin trap");
  for (const std::string move :
       {"rotate(37)", "rotate(90)", "mirror([1, 0, 0])", "mirror([1, 1, 0])",
        "translate([3.3, -40.7, 0])", "translate([0, 0, 1.7])"}) {
    EXPECT_EQ(
        without_overhangs(check(move + " {" + std::string(kFigure) + "}")),
        findings)
        << move;
  }
}

// Cuts in the lower half of a plate, which the upper one bridges.
struct Cut {
  std::string shape;
  double width = 0;
  double area = 0;  // of what hangs over, with this reach
};
constexpr double kReach = 0.1015;

std::vector<Cut> cuts() {
  std::vector<Cut> all;
  const auto inner = [](double size) { return size - 2 * kReach; };
  for (const double width : {0.25, 0.3, 0.5, 1.7}) {
    // Slots, blind at both ends.
    for (const double turn : {0.0, 3.0, 30.0, 45.0, 60.0, 88.0, 90.0}) {
      all.push_back(
          {fmt::format("for (i = [-2 : 2]) rotate({0}) translate("
                       "[-20, {1} + i * 4.7, -1]) cube([40, {1}, 2]);",
                       turn, width),
           width, 5 * inner(40) * inner(width)});
    }
    all.push_back(
        {fmt::format("translate([0.03, 0.04, -1]) cube([{0}, {0}, 2]);", width),
         width, inner(width) * inner(width)});
  }
  return all;
}

std::string plate(const Cut& cut) {
  return "difference() { translate([-40, -40, 0]) cube([80, 80, 2]);" +
         cut.shape + "}";
}

// Without those that are too small to matter.
std::string overhangs_text(const PrintCheck& print) {
  std::string text;
  for (const Finding& finding : print.findings) {
    if (finding.kind != FindingKind::kOverhang || finding.is_minor) continue;
    text += fmt::format("{:.9f} mm2, {:.9f} mm out in {}, {:.9f} mm wide\n",
                        finding.area, finding.distance, finding.first_layer,
                        finding.box.size().x);
  }
  return text;
}

TEST(PrintCheck, FindsBridgesOfEachWidthAndDirection) {
  for (const Cut& cut : cuts()) {
    double area = 0;
    double distance = 0;
    for (const Finding& finding : check(plate(cut)).findings) {
      if (finding.kind != FindingKind::kOverhang) continue;
      area += finding.area;
      distance = std::max(distance, finding.distance);
    }
    // Places are a tenth apart.
    EXPECT_NEAR(area, cut.area, 0.6 * cut.area + 0.01) << cut.shape;
    EXPECT_GT(distance, kReach) << cut.shape;
    EXPECT_GT(distance, cut.width / 2 - 0.05) << cut.shape;
    EXPECT_LT(distance, cut.width / 2 + 1e-9) << cut.shape;
  }
}

TEST(PrintCheck, KeepsItsOverhangsWhereAPostStandsFarAway) {
  for (const Cut& cut : cuts()) {
    const std::string found = overhangs_text(check(plate(cut)));
    for (const char* const post : {"translate([500, 0, 0]) cube(2);",
                                   "translate([-9000, 0, 0]) cube(2);",
                                   "translate([0, 700, 0]) cube(2);",
                                   "translate([-800, -800, 0]) cube(2);"}) {
      EXPECT_EQ(overhangs_text(check(plate(cut) + post)), found)
          << cut.shape << " " << post;
    }
  }
}

// Bridges as long as a plate and across it, in one ledge and in many.
TEST(PrintCheck, FindsNarrowBridgesInAWidePlate) {
  const std::string start = "difference() { cube([300, 300, 2]);";
  for (const auto& [cut, area] : std::vector<std::pair<std::string, double>>{
           {"for (i = [0 : 4]) translate([58.63 + 5.86 * i, -1, -1])"
            "cube([0.5, 302, 2]);",
            5 * 0.297 * 300},
           {"for (i = [0 : 4]) translate([-1, 1.8 + 2.35 * i, -1])"
            "cube([302, 0.5, 2]);",
            5 * 0.297 * 300},
           {"rotate(45) translate([1, 0, -1]) cube([400, 0.3, 2]);",
            0.097 * 300 * std::sqrt(2)},
           {"translate([0.3, 3, -1]) cube([299, 0.15, 2]);"
            "for (i = [0 : 498]) translate([0.3 + i * 0.6, 3, -1])"
            "cube([0.3, 40, 2]);",
            499 * 0.097 * 40}}) {
    double found = 0;
    for (const Finding& finding : check(start + cut + "}").findings) {
      if (finding.kind != FindingKind::kOverhang) continue;
      found += finding.area;
    }
    EXPECT_NEAR(found, area, 0.4 * area) << cut;
  }
}

TEST(PrintCheck, KeepsItsOverhangsInTheMirror) {
  for (const char* const side : {"0", "180", "90", "270"}) {
    const PrintCheck print =
        check(fmt::format("rotate({}) {{ {} }}", side, stairs(46, 0.1)));
    ASSERT_EQ(print.findings.size(), 1U) << side;
    EXPECT_NEAR(print.findings[0].distance, 0.1 * std::tan(46 * kPi / 180),
                1e-9);
  }
}

TEST(PrintCheck, LosesIslandsOnPillars) {
  const PrintCheck print = check(kFigure);
  std::string pillars = kFigure;
  for (const Finding& finding : print.findings) {
    if (finding.kind != FindingKind::kIsland &&
        finding.kind != FindingKind::kLoosePart) {
      continue;
    }
    pillars += fmt::format("translate([{}, {}, 0]) cylinder(d = 0.5, h = {});",
                           finding.place.x, finding.place.y, finding.section_z);
  }
  const PrintCheck held = check(pillars);
  EXPECT_EQ(held.count(FindingKind::kIsland), 0U);
  EXPECT_EQ(held.count(FindingKind::kLoosePart), 0U);
}

TEST(PrintCheck, IsTheSameForOneThreadAndSeveral) {
  const support::Design design = support::Design::from_text(kFigure);
  slicer::Settings settings;
  settings.layer_thickness = 0.02;
  std::vector<std::string> found;
  for (const unsigned threads : {1U, 3U}) {
    settings.threads = threads;
    slicer::LayerDrain drain;
    Diagnostics diagnostics;
    const auto report = slicer::slice(
        design.scene(), slicer::plan_layers(design.scene(), settings), settings,
        drain, diagnostics);
    std::string text;
    for (const Finding& finding : report.print->findings) {
      text += fmt::format("{} {} {} {} {}\n", slicer::name_of(finding.kind),
                          finding.first_layer, finding.last_layer, finding.area,
                          finding.place.x);
    }
    found.push_back(text);
  }
  EXPECT_EQ(found[0], found[1]);
}

// --- Pixels -----------------------------------------------------------------

class RandomPrints : public ::testing::TestWithParam<int> {};

TEST_P(RandomPrints, AgreeWithAFloodFillOfPixels) {
  const auto kind = static_cast<support::RandomKind>(GetParam());
  const std::uint32_t count = support::number_from("LAMINA_GRAPH_TRIALS", 12);
  const std::uint32_t first = support::number_from("LAMINA_GRAPH_SEED", 1);
  const double pitch = count > 12 ? 0.02 : 0.05;
  std::size_t islands = 0;
  std::size_t traps = 0;
  std::size_t judged = 0;
  for (std::uint32_t seed = first; seed - first < count; ++seed) {
    const std::string text = support::random_design(kind, seed, 12);
    Sliced sliced;
    try {
      const support::Design design = support::Design::from_text(text);
      const Vec3 size = design.scene().box.size();
      const double most = std::max({size.x, size.y, size.z});
      if (design.scene().box.is_empty() || most > 40) continue;
      sliced = slice(text, std::max(size.z / 40, 0.02));
    } catch (const std::exception&) {
      continue;  // no solid
    }
    ++judged;
    const support::PixelGraph pixels(sliced.layers, pitch);
    for (const std::string& words : pixels.complaints(sliced.print.findings)) {
      ADD_FAILURE() << "seed " << seed << ": " << words << "\n" << text;
    }
    islands += pixels.sure_islands();
    traps += pixels.sure_traps();
  }
  std::cout << judged << " designs, " << islands << " islands, " << traps
            << " traps\n";
}

INSTANTIATE_TEST_SUITE_P(Kinds, RandomPrints,
                         ::testing::Range(0, support::kRandomKindCount),
                         [](const auto& kind) {
                           return std::string(support::name_of(
                               static_cast<support::RandomKind>(kind.param)));
                         });

}  // namespace
}  // namespace lamina
