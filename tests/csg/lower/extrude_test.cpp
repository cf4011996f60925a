#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/csg/lower/lower_fixture.h"

namespace lamina::csg {
namespace {

using plane::area;

class LinearExtrudeTest : public LowerFixture {
 protected:
  // A square ring: an outline with a hole.
  Node* frame() {
    return b.node(Difference{},
                  {b.node(Square{{4, 4}, true}), b.node(Square{{2, 2}, true})});
  }
};
class RotateExtrudeTest : public LowerFixture {
 protected:
  // Volume of what a profile sweeps around a regular n-gon: Pappus, with the
  // n-gon's area in the place of the circle's.
  static double swept(double n, double area, double centroid_x) {
    return 2 * area * centroid_x * n / 2 * std::sin(2 * std::numbers::pi / n);
  }
};

TEST_F(LinearExtrudeTest, StraightOnesAreLofts) {
  const Scene scene = run_solid({b.linear_extrude({.height = 3}, {frame()})});
  ASSERT_EQ(scene.leaves.size(), 1u);
  EXPECT_EQ(scene.leaves[0].lofts.size(), 2u);
  EXPECT_TRUE(scene.leaves[0].meshes.empty());
  EXPECT_FALSE(scene.leaves[0].may_overlap_itself);
}

TEST_F(LinearExtrudeTest, HolesAreNotFilled) {
  EXPECT_NEAR(run_volume({b.linear_extrude({.height = 3}, {frame()})}), 36,
              1e-5);
}

TEST_F(LinearExtrudeTest, CenterMovesItHalfWayDown) {
  const Scene scene =
      run_solid({b.linear_extrude({.height = 3, .center = true}, {frame()})});
  EXPECT_EQ(scene.box.low.z, -1.5);
  EXPECT_EQ(scene.box.high.z, 1.5);
}

TEST_F(LinearExtrudeTest, AShiftedTopKeepsEachSection) {
  const LinearExtrudeParams upright{
      .height = 3, .twist_deg = 50, .has_twist = true, .slices = 4};
  LinearExtrudeParams leaning = upright;
  leaning.shift = {1, -2};
  leaning.center = true;
  EXPECT_NEAR(run_volume({b.linear_extrude(leaning, {frame()})}),
              run_volume({b.linear_extrude(upright, {frame()})}), 1e-9);
  const Scene scene = run_solid({b.linear_extrude(
      {.height = 3, .shift = {1, -2}, .center = true}, {frame()})});
  EXPECT_EQ(scene.box.low, Vec3(-2.5, -3, -1.5));
  EXPECT_EQ(scene.box.high, Vec3(2.5, 3, 1.5));
}

// A square of 4 points, on each of two rings.
TEST_F(LinearExtrudeTest, SegmentsDivideTheLongestEdges) {
  const auto points = [&](std::optional<int> segments, Vec2 size) {
    const LinearExtrudeParams params{.height = 3,
                                     .twist_deg = 30,
                                     .has_twist = true,
                                     .slices = 1,
                                     .segments = segments};
    const Scene scene =
        run_solid({b.linear_extrude(params, {b.node(Square{size, true})})});
    return scene.leaves[0].meshes[0].vertices.size() / 2;
  };
  EXPECT_EQ(points({}, {4, 4}), 4u);
  EXPECT_EQ(points(0, {4, 4}), 4u);
  EXPECT_EQ(points(7, {4, 4}), 4u) << "one more for each edge, or none";
  EXPECT_EQ(points(8, {4, 4}), 8u);
  EXPECT_EQ(points(64, {4, 4}), 64u);
  EXPECT_EQ(points(6, {9, 1}), 6u) << "both long edges";
  EXPECT_EQ(points(9, {9, 1}), 8u);
  language = Language::k2026;
  // No part longer than $fs = 2, and of $fa = 12 no more than 30 points.
  EXPECT_EQ(points({}, {4, 4}), 8u);
  EXPECT_EQ(points({}, {9, 1}), 12u);
  EXPECT_EQ(points({}, {40, 40}), 28u);
  EXPECT_EQ(points(0, {4, 4}), 4u);
}

TEST_F(LinearExtrudeTest, ScaledToNothingItIsAPyramid) {
  EXPECT_NEAR(run_volume({b.linear_extrude({.height = 3, .scale = Vec2(0)},
                                           {frame()})}),
              12, 1e-5);
}

TEST_F(LinearExtrudeTest, UnevenScaleIsAPrismatoid) {
  // Integral of 4(1 - t/2) · 4(1 + t) - 2(1 - t/2) · 2(1 + t) over the height.
  const double expected = 3 * 12 * (1 + 0.25 - 1.0 / 6);
  EXPECT_NEAR(run_volume({b.linear_extrude(
                  {.height = 3, .slices = 50, .scale = {0.5, 2}}, {frame()})}),
              expected, 1e-3);
}

TEST_F(LinearExtrudeTest, APinchedTopStaysClosed) {
  EXPECT_NEAR(
      run_volume({b.linear_extrude({.height = 3, .slices = 1, .scale = {1, 0}},
                                   {b.node(Square{{4, 2}, true})})}),
      12, 1e-9);
}

TEST_F(LinearExtrudeTest, TwistKeepsTheVolumeInTheLimit) {
  // Every diagonal adds or takes a sliver, in all as much as a slice turns.
  const auto error = [&](int slices) {
    const LinearExtrudeParams params{
        .height = 3, .twist_deg = 90, .has_twist = true, .slices = slices};
    return run_volume({b.linear_extrude(params, {frame()})}) - 36;
  };
  EXPECT_NEAR(error(400), 0, 0.05);
  EXPECT_NEAR(error(400) / error(800), 2, 0.01);
}

TEST_F(LinearExtrudeTest, EqualExtrusionsAreOneLeaf) {
  const auto stud = [&] { return b.linear_extrude({.height = 3}, {frame()}); };
  const Scene scene = run_solid({stud(), b.translate({9, 0, 0}, {stud()})});
  EXPECT_EQ(scene.leaves.size(), 1u);
  EXPECT_EQ(scene.instances.size(), 2u);
}

TEST_F(LinearExtrudeTest, WithoutHeightItIsEmpty) {
  EXPECT_TRUE(run({b.linear_extrude({.height = 0}, {frame()})}).is_empty());
}

TEST_F(RotateExtrudeTest, ATorusIsOneLoftWithAClosedProfile) {
  const Scene scene =
      run_solid({b.node(RotateExtrude{360, 2, {16}},
                        {b.translate({5, 0, 0}, {b.node(Circle{1, {8}})})})});
  ASSERT_EQ(scene.leaves[0].lofts.size(), 1u);
  EXPECT_TRUE(scene.leaves[0].lofts[0].is_closed_profile);
}

TEST_F(RotateExtrudeTest, FollowsPappus) {
  EXPECT_NEAR(run_volume({b.node(
                  RotateExtrude{360, 2, {16}},
                  {b.translate({5, 0, 0}, {b.node(Square{{2, 3}, true})})})}),
              swept(16, 6, 5), 1e-9);
}

// Pappus again: a part of a turn is as many equal wedges as it has facets.
TEST_F(RotateExtrudeTest, APartOfATurnBeginsWhereItIsTold) {
  const auto ring = [&](double start, double angle) {
    return b.node(
        RotateExtrude{.angle_deg = angle, .facets = {18}, .start_deg = start},
        {b.translate({5, 0, 0}, {b.node(Square{{2, 3}, true})})});
  };
  for (const double start : {0.0, 20.0, -130.0}) {
    EXPECT_NEAR(run_volume({ring(start, 100)}), swept(18, 6, 5) * 5 / 18, 1e-9);
    EXPECT_NEAR(run_volume({ring(start, -100)}), swept(18, 6, 5) * 5 / 18,
                1e-9);
    EXPECT_NEAR(run_volume({ring(start, 360)}), swept(18, 6, 5), 1e-9);
  }
  const Box3 quarter = run_solid({ring(90, 80)}).box;
  EXPECT_NEAR(quarter.high.x, 0, 1e-12);
  EXPECT_NEAR(quarter.high.y, 6, 1e-12);
  EXPECT_NEAR(quarter.low.x, -6 * std::cos(std::numbers::pi / 18), 1e-12);
}

// 7 sides over 100 degrees: 1.94 of them, or 2 of 50 degrees each.
TEST_F(RotateExtrudeTest, FacetsOfAPartAreRoundedUpInNewerDesigns) {
  const auto volume = [&] {
    return run_volume(
        {b.node(RotateExtrude{100, 2, {7}}, {b.node(Square{{1, 1}})})});
  };
  const auto wedge = [](double degrees) {
    return std::sin(degrees * std::numbers::pi / 180) / 2;
  };
  EXPECT_NEAR(volume(), wedge(100), 1e-9);
  language = Language::k2026;
  EXPECT_NEAR(volume(), 2 * wedge(50), 1e-9);
}

TEST_F(RotateExtrudeTest, ProfilesOnTheNegativeSideDoToo) {
  EXPECT_NEAR(run_volume({b.node(
                  RotateExtrude{360, 2, {15}},
                  {b.translate({-5, 0, 0}, {b.node(Square{{2, 3}, true})})})}),
              swept(15, 6, 5), 1e-9);
}

TEST_F(RotateExtrudeTest, AProfileOnTheAxisHasApexes) {
  const auto scene = run_solid(
      {b.node(RotateExtrude{360, 2, {16}}, {b.node(Square{{2, 3}, false})})});
  const Loft& loft = scene.leaves[0].lofts.at(0);
  EXPECT_FALSE(loft.is_closed_profile);
  EXPECT_EQ(loft.profile.front().x, 0);
  EXPECT_EQ(loft.profile.back().x, 0);
  EXPECT_NEAR(run_volume({b.node(RotateExtrude{360, 2, {16}},
                                 {b.node(Square{{2, 3}, false})})}),
              swept(16, 6, 1), 1e-9);
}

TEST_F(RotateExtrudeTest, AShellOnTheAxisHasACavity) {
  // A box around a smaller one, both with a side on the axis.
  Node* profile = b.polygon(
      {{0, 0}, {3, 0}, {3, 6}, {0, 6}, {0, 5}, {2, 5}, {2, 1}, {0, 1}});
  const Scene scene =
      run_solid({b.node(RotateExtrude{360, 2, {16}}, {profile})});
  ASSERT_EQ(scene.leaves[0].lofts.size(), 2u);
  EXPECT_NE(scene.leaves[0].lofts[0].is_cavity,
            scene.leaves[0].lofts[1].is_cavity);
  EXPECT_NEAR(run_volume({b.node(RotateExtrude{360, 2, {16}}, {profile})}),
              swept(16, 18, 1.5) - swept(16, 8, 1), 1e-6);
}

TEST_F(RotateExtrudeTest, PartsOfATurnAddUpToOne) {
  const auto part = [&](double angle, double fn) {
    return run_volume(
        {b.node(RotateExtrude{angle, 2, {fn}},
                {b.translate({5, 0, 0}, {b.node(Square{{2, 3}, true})})})});
  };
  const double whole = part(360, 16);
  EXPECT_NEAR(part(90, 16), whole / 4, 1e-9);
  EXPECT_NEAR(part(-90, 16), whole / 4, 1e-9);
  EXPECT_NEAR(part(270, 16), 3 * whole / 4, 1e-9);
}

TEST_F(RotateExtrudeTest, PartsOfATurnTouchTheAxis) {
  for (const double x : {1.0, -1.0}) {
    for (const double angle : {90.0, -90.0}) {
      EXPECT_NEAR(
          run_volume({b.node(
              RotateExtrude{angle, 2, {16}},
              {b.translate({x, 0, 0}, {b.node(Square{{2, 3}, true})})})}),
          swept(16, 6, 1) / 4, 1e-9);
    }
  }
}

// As where corners were computed.
TEST_F(RotateExtrudeTest, RoundingDoesNotCrossTheAxis) {
  const double beyond = -1e-14;
  EXPECT_NEAR(
      run_volume({b.node(
          RotateExtrude{360, 2, {16}},
          {b.translate({1 + beyond, 0, 0}, {b.node(Square{{2, 3}, true})})})}),
      swept(16, 6, 1), 1e-9);
}

TEST_F(RotateExtrudeTest, MustNotCrossTheAxis) {
  EXPECT_TRUE(run({b.node(RotateExtrude{}, {b.node(Square{{4, 4}, true})})})
                  .is_empty());
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_EQ(diagnostics.all()[0].severity, Severity::kError);
  EXPECT_EQ(diagnostics.all()[0].message,
            "all points for rotate_extrude() must have the same X coordinate "
            "sign (range is -2.00 -> 2.00)");
}

}  // namespace
}  // namespace lamina::csg
