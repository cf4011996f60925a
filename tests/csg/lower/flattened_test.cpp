// Solids scaled by 0. OpenSCAD 2021.01 removes what is the result of a Boolean;
// of anything else it keeps the faces, which hulls, sums and shadows see.

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "plane/region/region.h"
#include "tests/csg/lower/lower_fixture.h"

namespace lamina::csg {
namespace {

class Flattened : public LowerFixture {
 protected:
  // A unit square in the plane x = 0, and a point.
  const Node* square() { return b.scale({0, 1, 1}, {b.cube(Vec3(1))}); }
  const Node* point() { return b.scale(Vec3(0), {b.cube(Vec3(1))}); }
  const Node* pair() {
    return b.node(Union{}, {b.cube(Vec3(1)), b.cube(Vec3(2))});
  }

  double sum_volume(const TreeBuilder::Children& children) {
    return run_volume({b.node(Minkowski{}, children)});
  }
};

TEST_F(Flattened, HaveNoVolume) {
  EXPECT_TRUE(run({square()}).is_empty());
  EXPECT_NEAR(run_volume({square(), b.cube({1, 2, 3})}), 6, kRounding);
  EXPECT_TRUE(messages().empty());
}

// The determinant of the inner matrix is 1e-900.
TEST_F(Flattened, SmallMatricesAreNotFlat) {
  const Node* cube = b.scale(Vec3(1e-300), {b.cube(Vec3(2))});
  EXPECT_NEAR(run_volume({b.scale(Vec3(1e300), {cube})}), 8, kRounding);
  const Node* bar = b.scale({1e-300, 1, 1e200}, {b.cube(Vec3(1))});
  EXPECT_NEAR(run_volume({b.scale({1e300, 1, 1e-200}, {bar})}), 1, kRounding);
}

TEST_F(Flattened, ResultsOfBooleansAreRemoved) {
  const std::vector<std::string> warning{
      "Scaling a 3D object with 0 - removing object"};
  EXPECT_NEAR(run_volume({b.node(
                  Hull{}, {b.scale({0, 1, 1}, {pair()}), b.cube(Vec3(1))})}),
              1, kRounding);
  EXPECT_EQ(messages(), warning);
}

TEST_F(Flattened, AUnionOfOneIsNoBoolean) {
  const Node* one =
      b.node(Union{}, {b.node(Group{}), b.cube({0, 1, 1}), b.cube(Vec3(1))});
  const Node* flat = b.scale({0, 1, 1}, {one});
  EXPECT_NEAR(run_volume({b.node(
                  Hull{}, {flat, b.translate({3, 0, 0}, {b.cube(Vec3(1))})})}),
              4, kRounding);
  EXPECT_TRUE(messages().empty());
}

TEST_F(Flattened, HullsTakeTheirCorners) {
  EXPECT_NEAR(
      run_volume({b.node(
          Hull{}, {square(), b.translate({3, 0, 0}, {b.cube(Vec3(1))})})}),
      4, kRounding);
  // A pyramid.
  EXPECT_NEAR(run_volume({b.node(
                  Hull{}, {b.translate({6, 0, 0}, {point()}), square()})}),
              2, kRounding);
  // Turned and united, they are the same.
  EXPECT_NEAR(run_volume({b.node(
                  Hull{}, {b.scale({1, -1, 1}, {square()}),
                           b.node(Union{}, {square(), b.cube(Vec3(1))})})}),
              1.5, kRounding);
}

TEST_F(Flattened, ShadowsShowThem) {
  const Node* flat = b.scale({1, 1, 0}, {b.cube({2, 3, 4})});
  for (const bool cut : {false, true}) {
    EXPECT_NEAR(plane::area(run_flat({b.node(Projection{cut}, {flat})})), 6,
                kRounding);
    EXPECT_TRUE(run({b.node(Projection{cut}, {square()})}).is_empty());
  }
  const Node* above = b.translate({0, 0, 1}, {flat});
  EXPECT_TRUE(run({b.node(Projection{true}, {above})}).is_empty());
  EXPECT_EQ(messages(), std::vector<std::string>{"Projection() failed."});
}

TEST_F(Flattened, SumsWithThemAreSwept) {
  EXPECT_NEAR(sum_volume({square(), b.cube({2, 3, 4})}), 2 * 4 * 5, kRounding);
  EXPECT_NEAR(sum_volume({b.cube({2, 3, 4}), square()}), 2 * 4 * 5, kRounding);
  // An edge, and the edge across it.
  const Node* edge = b.scale({1, 0, 0}, {b.cube(Vec3(3))});
  EXPECT_NEAR(sum_volume({edge, square()}), 3, kRounding);
  EXPECT_NEAR(sum_volume({edge, b.cube(Vec3(1))}), 4, kRounding);
  EXPECT_NEAR(sum_volume({b.translate({5, 0, 0}, {point()}), b.cube(Vec3(2))}),
              8, kRounding);
}

TEST_F(Flattened, SumsThatBeginWithoutVolumeAreEmpty) {
  const auto edge = [&](const Vec3& along) {
    return b.scale(along, {b.cube(Vec3(1))});
  };
  const Node* x = edge({1, 0, 0});
  const Node* y = edge({0, 1, 0});
  const Node* z = edge({0, 0, 1});
  EXPECT_TRUE(run({b.node(Minkowski{}, {x, y, z})}).is_empty());
  EXPECT_TRUE(run({b.node(Minkowski{}, {x, y, b.cube(Vec3(1))})}).is_empty());
  EXPECT_NEAR(sum_volume({x, b.cube(Vec3(1)), y}), 2 * 2 * 1, kRounding);
  EXPECT_NEAR(sum_volume({x, edge({0, 1, 1}), y}), 2, kRounding);
}

TEST_F(Flattened, SumsWithAPointAreMoved) {
  const Node* point_at = b.translate({5, 6, 7}, {point()});
  const Scene scene =
      run_solid({b.node(Minkowski{}, {point_at, b.cube(Vec3(2))})});
  EXPECT_EQ(scene.box.low, Vec3(5, 6, 7));
  EXPECT_EQ(scene.box.high, Vec3(7, 8, 9));
}

TEST_F(Flattened, BooleansLeaveThemOut) {
  const Node* cube = b.cube(Vec3(1));
  const Node* turned =
      b.transform(Mat4({0, 1, 0, 0}, {-1, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}),
                  {square()});
  EXPECT_NEAR(run_volume({b.node(Difference{}, {cube, square(), turned})}), 1,
              kRounding);
  EXPECT_TRUE(run({b.node(Difference{}, {turned, cube})}).is_empty());
  EXPECT_TRUE(run({b.node(Intersection{}, {cube, turned})}).is_empty());
}

TEST_F(Flattened, KeepTheirFlatnessWhenResized) {
  const Node* flat = b.scale({1, 1, 0}, {b.cube({2, 3, 4})});
  const Node* resized =
      b.node(Resize{{4, 0, 5}, {false, false, false}}, {flat});
  EXPECT_NEAR(plane::area(run_flat({b.node(Projection{false}, {resized})})), 12,
              kRounding);
}

}  // namespace
}  // namespace lamina::csg
