#include <limits>

#include <gtest/gtest.h>

#include "tests/csg/lower/lower_fixture.h"

namespace lamina::csg {
namespace {

class LowerPlanarTest : public LowerFixture {};

TEST_F(LowerPlanarTest, AFlatDesignGivesItsOutline) {
  const auto region =
      run_flat({b.node(Difference{}, {b.node(Square{{4, 4}, true}),
                                      b.node(Square{{2, 2}, true})})});
  EXPECT_EQ(planar::area(region), 12);
  EXPECT_EQ(region.contours.size(), 2u);
}

TEST_F(LowerPlanarTest, AMirrorKeepsOuterContoursCounterClockwise) {
  const auto region = run_flat({b.scale(
      {-2, 1, 1}, {b.translate({1, 0, 0}, {b.node(Square{{1, 1}, false})})})});
  EXPECT_EQ(planar::area(region), 2);
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
  EXPECT_EQ(planar::area(run_flat({b.polygon(polygon)})), 15);
  EXPECT_EQ(messages(),
            (std::vector<std::string>{
                "Point index 9 is out of bounds (from paths[1][4])"}));
}

TEST_F(LowerPlanarTest, WithoutPathsAPolygonIsAllPoints) {
  EXPECT_EQ(planar::area(run_flat({b.polygon({{0, 0}, {2, 0}, {0, 2}})})), 2);
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
  EXPECT_EQ(planar::area(run_flat({b.polygon(polygon)})), 2);
  EXPECT_EQ(messages(), std::vector<std::string>{
                            "Range check failed for polygon. skipping"});
}

TEST_F(LowerPlanarTest, FillTakesHolesAway) {
  const auto region = run_flat(
      {b.node(Fill{}, {b.node(Difference{}, {b.node(Square{{4, 4}, true}),
                                             b.node(Square{{2, 2}, true})})})});
  EXPECT_EQ(planar::area(region), 16);
}

TEST_F(LowerPlanarTest, FillLeavesSolidsAndSaysSo) {
  EXPECT_EQ(run_solid({b.node(Fill{}, {b.cube(Vec3(1))})}).instances.size(),
            1u);
  EXPECT_EQ(messages(),
            (std::vector<std::string>{"fill() not yet implemented for 3D"}));
}

TEST_F(LowerPlanarTest, MinkowskiAddsFlatChildren) {
  EXPECT_EQ(planar::area(run_flat(
                {b.node(Minkowski{}, {b.node(Square{{4, 4}, true}),
                                      b.node(Square{{1, 2}, true})})})),
            5 * 6);
}

// As openscad 2021.01 has it.
TEST_F(LowerPlanarTest, MinkowskiPassesOverEmptyChildrenUnlessOneIsLeft) {
  const auto big = [&] { return b.node(Square{{4, 4}, true}); };
  const auto small = [&] { return b.node(Square{{1, 1}, true}); };
  const auto nothing = [&] { return b.node(Square{{0, 0}, true}); };
  EXPECT_EQ(planar::area(
                run_flat({b.node(Minkowski{}, {big(), nothing(), small()})})),
            25);
  EXPECT_EQ(planar::area(
                run_flat({b.node(Minkowski{}, {big(), small(), nothing()})})),
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
      planar::area(run_flat({b.node(offset, {b.node(Square{{2, 2}, true}),
                                             b.node(Square{{4, 1}, true})})})),
      6 * 3 + 2 * 4 * 0.5, 1e-5);
}

}  // namespace
}  // namespace lamina::csg
