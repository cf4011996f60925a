#include <bitset>
#include <cstddef>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "csg/degrees.h"
#include "tests/csg/lower/lower_fixture.h"

namespace lamina::csg {
namespace {

class LowerPlanarTest : public LowerFixture {
 protected:
  // Unit squares of a grid of 16 x 16.
  using Cells = std::bitset<256>;

  // A random tree of operators over rectangles of the grid, and its cells.
  std::pair<const Node*, Cells> grow(std::mt19937& random, int depth) {
    const auto below = [&](unsigned n) {
      return static_cast<int>(random() % n);
    };
    if (depth == 0) {
      const int x = below(12);
      const int y = below(12);
      const int w = 1 + below(static_cast<unsigned>(16 - x));
      const int h = 1 + below(static_cast<unsigned>(16 - y));
      Cells cells;
      for (int i = x; i < x + w; ++i) {
        for (int k = y; k < y + h; ++k) {
          cells.set(static_cast<std::size_t>(16 * k + i));
        }
      }
      return {b.translate(Vec3(x, y, 0), {b.node(Square{Vec2(w, h), false})}),
              cells};
    }
    const int op = below(4);
    TreeBuilder::Children children;
    Cells cells;
    for (int i = 1 + below(4); i > 0; --i) {
      const auto [child, more] = grow(random, below(3) > 0 ? depth - 1 : 0);
      cells = children.empty() ? more
              : op == 0        ? cells & more
              : op == 1        ? cells | more
                               : cells & ~more;
      children.push_back(child);
    }
    return {op == 0   ? b.node(Intersection{}, children)
            : op == 1 ? b.node(Union{}, children)
                      : b.node(Difference{}, children),
            cells};
  }
};

// Operators in each other are one where they can be; the set is that of each
// in turn.
TEST_F(LowerPlanarTest, NestedOperatorsHoldTheCellsThatTheyDoOneByOne) {
  std::mt19937 random(1);
  int full = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const auto [node, cells] = grow(random, 5);
    const Lowered lowered = run({node});
    const double area = lowered.outline() ? plane::area(*lowered.outline()) : 0;
    EXPECT_NEAR(area, static_cast<double>(cells.count()), 1e-6);
    if (cells.any()) ++full;
  }
  EXPECT_GT(full, 100);
}

// Discs that are drawn out to a bar; bench/bombs has its cost at 2,400 levels.
TEST_F(LowerPlanarTest, AUnionOfManyLevelsHoldsEachDisc) {
  constexpr int kSides = 998;  // so that edges are at the top and the bottom
  constexpr double kRadius = 10;
  constexpr double kShift = 0.01;
  constexpr int kLevels = 300;
  const auto disc = [&] { return b.node(Circle{kRadius, {.fn = kSides}}); };
  const Node* node = disc();
  for (int i = 1; i < kLevels; ++i) {
    node = b.node(Union{}, {b.node(Group{}, {node}),
                            b.translate({kShift * i, 0, 0}, {disc()})});
  }
  const double height = 2 * kRadius * cos_deg(180.0 / kSides);
  EXPECT_NEAR(plane::area(run_flat({node})),
              kSides / 2.0 * kRadius * kRadius * sin_deg(360.0 / kSides) +
                  kShift * (kLevels - 1) * height,
              1e-5);
}

TEST_F(LowerPlanarTest, ADifferenceOfManyLevelsLosesEachBar) {
  const Node* node = b.node(Square{{100, 300}, false});
  for (int i = 0; i < 100; ++i) {
    node =
        b.node(Difference{}, {b.node(Group{}, {node}),
                              b.translate(Vec3(10, 3 * i + 1, 0),
                                          {b.node(Square{{80, 1}, false})})});
  }
  const auto region = run_flat({node});
  EXPECT_NEAR(plane::area(region), 100 * 300 - 100 * 80, 1e-6);
  EXPECT_EQ(region.contours.size(), 101u);
}

TEST_F(LowerPlanarTest, TransformsBetweenOperatorsMoveAllOperands) {
  const Node* frame = b.node(
      Difference{}, {b.node(Square{{4, 4}, false}),
                     b.translate({1, 1, 0}, {b.node(Square{{2, 2}, false})})});
  const auto region = run_flat(
      {b.node(Difference{},
              {b.scale({-2, 1, 1}, {b.translate({1, 0, 0}, {frame})}),
               b.translate({-4, 0, 0}, {b.node(Square{{2, 9}, false})})})});
  // The frame stands from -10 to -2; the hole from -8 to -4.
  EXPECT_NEAR(plane::area(region), 2 * 12 - 2 * 4, 1e-6);
  EXPECT_TRUE(run({b.node(Union{}, {b.scale({0, 1, 1}, {b.node(Square{}),
                                                        b.node(Circle{})})})})
                  .is_empty());
  EXPECT_EQ(messages(), (std::vector<std::string>{
                            "Scaling a 2D object with 0 - removing object"}));
}

// What an operator leaves decides whether it is mixed in, not its operands.
TEST_F(LowerPlanarTest, ADifferenceThatLeavesNothingIsNotMixed) {
  const auto nothing = [&] {
    return b.node(Difference{}, {b.node(Square{{1, 1}, false}),
                                 b.node(Square{{2, 2}, false})});
  };
  run_solid({b.node(Intersection{}, {b.cube(Vec3(1)), b.cube(Vec3(1))}),
             b.node(Union{}, {nothing(), nothing()})});
  EXPECT_EQ(
      messages(),
      (std::vector<std::string>{"Ignoring 2D child object for 3D operation"}));
}

// As in OpenSCAD. An empty outline itself is one, and so are two.
TEST_F(LowerPlanarTest, OperatorsAroundOneEmptyOutlineAreNothing) {
  const auto empty = [&]() -> const Node* {
    return b.node(Square{{0, 1}, false});
  };
  const Node* difference =
      b.node(Difference{},
             {b.node(Square{{1, 1}, false}), b.node(Square{{2, 2}, false})});
  for (const Node* nothing : std::vector<const Node*>{
           b.node(Group{}, {empty()}), b.node(Union{}, {difference}),
           b.node(Intersection{}, {b.node(Difference{}, {empty()})}),
           b.translate({1, 2, 3}, {empty()}),
           b.scale({0, 1, 1}, {b.node(Render{}, {empty()})}),
           b.node(Resize{Vec3(3), {}}, {empty()})}) {
    EXPECT_EQ(run_solid({nothing, b.cube(Vec3(1))}).instances.size(), 1u);
  }
  EXPECT_TRUE(diagnostics.all().empty());
  for (const Node* outline : std::vector<const Node*>{
           empty(), difference, b.node(Union{}, {empty(), empty()})}) {
    EXPECT_TRUE(run({outline, b.cube(Vec3(1))}).is_empty());
  }
}

// As in OpenSCAD: solids that leave nothing are an empty solid, unless they are
// united, or one that another is intersected with is empty itself.
TEST_F(LowerPlanarTest, EmptySolidsDecideTheDimension) {
  const auto empty = [&]() -> const Node* { return b.cube(Vec3(0)); };
  const auto none = [&]() -> const Node* { return b.node(Group{}, {}); };
  const auto cube = [&]() -> const Node* { return b.cube(Vec3(1)); };
  const auto far_cube = [&]() -> const Node* {
    return b.translate({5, 0, 0}, {b.cube(Vec3(1))});
  };
  for (const Node* solid :
       std::vector<const Node*>{empty(), b.node(Union{}, {empty()}),
                                b.node(Difference{}, {empty(), cube()}),
                                b.node(Intersection{}, {cube(), far_cube()}),
                                b.node(Intersection{}, {empty(), cube()})}) {
    EXPECT_TRUE(run({solid, b.node(Square{})}).is_empty());
  }
  for (const Node* nothing :
       std::vector<const Node*>{b.node(Union{}, {empty(), empty()}),
                                b.node(Resize{Vec3(3), {}}, {empty(), empty()}),
                                b.node(Difference{}, {none(), cube()}),
                                b.node(Intersection{}, {cube(), empty()}),
                                b.node(Intersection{}, {none(), cube()})}) {
    EXPECT_EQ(plane::area(run_flat({nothing, b.node(Square{})})), 1);
  }
}

TEST_F(LowerPlanarTest, WhatStandsBetweenOperatorsSeesTheResult) {
  const auto frame = [&] {
    return b.node(Difference{},
                  {b.node(Square{{4, 4}, true}), b.node(Square{{2, 2}, true})});
  };
  const Node* cut = b.node(Square{{1, 9}, true});
  EXPECT_NEAR(plane::area(run_flat(
                  {b.node(Difference{}, {b.node(Fill{}, {frame()}), cut})})),
              12, 1e-6);
  EXPECT_NEAR(
      plane::area(run_flat({b.node(
          Difference{},
          {b.node(Offset{.amount = 0.5, .is_delta = true}, {frame()}), cut})})),
      25 - 1 - 4, 1e-6);
}

TEST_F(LowerPlanarTest, AFlatDesignGivesItsOutline) {
  const auto region =
      run_flat({b.node(Difference{}, {b.node(Square{{4, 4}, true}),
                                      b.node(Square{{2, 2}, true})})});
  EXPECT_EQ(plane::area(region), 12);
  EXPECT_EQ(region.contours.size(), 2u);
}

TEST_F(LowerPlanarTest, AMirrorKeepsOuterContoursCounterClockwise) {
  const auto region = run_flat({b.scale(
      {-2, 1, 1}, {b.translate({1, 0, 0}, {b.node(Square{{1, 1}, false})})})});
  EXPECT_EQ(plane::area(region), 2);
}

TEST_F(LowerPlanarTest, TheFirstChildDecidesTheDimension) {
  EXPECT_NE(run({b.node(Square{}), b.cube(Vec3(1))}).outline(), nullptr);
  EXPECT_EQ(messages(), (std::vector<std::string>{
                            "Mixing 2D and 3D objects is not supported",
                            "Ignoring 3D child object for 2D operation"}));
}

TEST_F(LowerPlanarTest, FlatChildrenOfASolidAreIgnored) {
  const Scene scene =
      run_solid({b.cube(Vec3(1)), b.node(Square{}), b.node(Circle{})});
  EXPECT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(messages(), (std::vector<std::string>{
                            "Mixing 2D and 3D objects is not supported",
                            "Ignoring 2D child object for 3D operation",
                            "Ignoring 2D child object for 3D operation"}));
}

TEST_F(LowerPlanarTest, ExtrusionsIgnoreSolids) {
  const Scene scene = run_solid({b.linear_extrude(
      {.height = 2}, {b.cube(Vec3(9)), b.node(Square{{1, 1}, false})})});
  EXPECT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.box.high, Vec3(1, 1, 2));
  EXPECT_EQ(
      messages(),
      (std::vector<std::string>{"Ignoring 3D child object for 2D operation"}));
}

TEST_F(LowerPlanarTest, ZeroScaleRemovesWithAWarning) {
  EXPECT_TRUE(run({b.scale({0, 1, 1}, {b.node(Square{})})}).is_empty());
  EXPECT_EQ(messages(), (std::vector<std::string>{
                            "Scaling a 2D object with 0 - removing object"}));
}

TEST_F(LowerPlanarTest, PolygonsTakePathsWithHoles) {
  const std::vector<Vec2> points{{0, 0}, {4, 0}, {4, 4}, {0, 4},
                                 {1, 1}, {2, 1}, {2, 2}, {1, 2}};
  PolygonParams polygon{b.copy(std::span<const Vec2>(points)), {}, 1};
  polygon.paths = b.copy_lists({{0, 1, 2, 3}, {4, 5, 6, 7, 9}});
  EXPECT_EQ(plane::area(run_flat({b.polygon(polygon)})), 15);
  EXPECT_EQ(messages(),
            (std::vector<std::string>{
                "Point index 9 is out of bounds (from paths[1][4])"}));
}

TEST_F(LowerPlanarTest, WithoutPathsAPolygonIsAllPoints) {
  EXPECT_EQ(plane::area(run_flat({b.polygon({{0, 0}, {2, 0}, {0, 2}})})), 2);
  EXPECT_TRUE(run({b.polygon({{0, 0}, {2, 0}})}).is_empty());
}

TEST_F(LowerPlanarTest, PointsThatAreNoneMakeAnEmptyPolygon) {
  const std::vector<Vec2> points{{0, 0}, {2, 0}, {0, 2}};
  PolygonParams polygon{b.copy(std::span<const Vec2>(points)), {}, 1};
  polygon.wrong_point = "points[2] = [0]";
  EXPECT_TRUE(run({b.polygon(polygon)}).is_empty());
  EXPECT_EQ(messages(),
            (std::vector<std::string>{
                "Unable to convert points[2] = [0] to a vec2 of numbers"}));
}

// OpenSCAD takes the contours until one has a coordinate that is no number.
TEST_F(LowerPlanarTest, ContoursWithoutNumbersAreLeftOut) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vec2> points{{0, 0}, {2, 0}, {0, 2}, {nan, 5},
                                 {9, 9}, {9, 8}, {8, 9}};
  PolygonParams polygon{b.copy(std::span<const Vec2>(points)), {}, 1};
  polygon.paths = b.copy_lists({{0, 1, 2}, {0, 1, 3}, {4, 5, 6}});
  EXPECT_EQ(plane::area(run_flat({b.polygon(polygon)})), 2);
  EXPECT_EQ(messages(), std::vector<std::string>{
                            "Range check failed for polygon. skipping"});
}

TEST_F(LowerPlanarTest, FillTakesHolesAway) {
  const auto region = run_flat(
      {b.node(Fill{}, {b.node(Difference{}, {b.node(Square{{4, 4}, true}),
                                             b.node(Square{{2, 2}, true})})})});
  EXPECT_EQ(plane::area(region), 16);
}

TEST_F(LowerPlanarTest, FillLeavesSolidsAndSaysSo) {
  EXPECT_EQ(run_solid({b.node(Fill{}, {b.cube(Vec3(1))})}).instances.size(),
            1u);
  EXPECT_EQ(messages(),
            (std::vector<std::string>{"fill() not yet implemented for 3D"}));
}

TEST_F(LowerPlanarTest, MinkowskiAddsFlatChildren) {
  EXPECT_EQ(plane::area(run_flat(
                {b.node(Minkowski{}, {b.node(Square{{4, 4}, true}),
                                      b.node(Square{{1, 2}, true})})})),
            5 * 6);
}

// As openscad 2021.01 has it.
TEST_F(LowerPlanarTest, MinkowskiPassesOverEmptyChildrenUnlessOneIsLeft) {
  const auto big = [&] { return b.node(Square{{4, 4}, true}); };
  const auto small = [&] { return b.node(Square{{1, 1}, true}); };
  const auto nothing = [&] { return b.node(Square{{0, 0}, true}); };
  EXPECT_EQ(
      plane::area(run_flat({b.node(Minkowski{}, {big(), nothing(), small()})})),
      25);
  EXPECT_EQ(
      plane::area(run_flat({b.node(Minkowski{}, {big(), small(), nothing()})})),
      25);
  EXPECT_TRUE(run({b.node(Minkowski{}, {big(), nothing()})}).is_empty());
  EXPECT_TRUE(run({b.node(Minkowski{}, {nothing(), big()})}).is_empty());
}

TEST_F(LowerPlanarTest, MinkowskiDoesNotMixDimensions) {
  EXPECT_TRUE(run({b.node(Minkowski{}, {b.node(Square{}), b.cube(Vec3(1))})})
                  .is_empty());
  EXPECT_EQ(messages(), (std::vector<std::string>{
                            "Mixing 2D and 3D objects is not supported",
                            "Ignoring 3D child object for 2D operation"}));
}

TEST_F(LowerPlanarTest, OffsetGrowsTheUnionOfItsChildren) {
  Offset offset{.amount = 1, .is_delta = true};
  EXPECT_NEAR(
      plane::area(run_flat({b.node(offset, {b.node(Square{{2, 2}, true}),
                                            b.node(Square{{4, 1}, true})})})),
      6 * 3 + 2 * 4 * 0.5, 1e-5);
}

}  // namespace
}  // namespace lamina::csg
