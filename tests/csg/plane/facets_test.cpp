#include "csg/plane/facets.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "csg/degrees.h"

namespace lamina::planar {
namespace {

TEST(SinDeg, IsExactAtMultiplesOfThirtyAndFortyFive) {
  EXPECT_EQ(csg::sin_deg(30), 0.5);
  EXPECT_EQ(csg::sin_deg(-30), -0.5);
  EXPECT_EQ(csg::cos_deg(60), 0.5);
  EXPECT_EQ(csg::cos_deg(90), 0);
  EXPECT_EQ(csg::sin_deg(180), 0);
  EXPECT_EQ(csg::sin_deg(45), csg::cos_deg(45));
  EXPECT_EQ(csg::cos_deg(150), -csg::sin_deg(60));
  EXPECT_EQ(csg::sin_deg(3690), 1);
}

TEST(SinDeg, AgreesWithTheLibraryElsewhere) {
  for (int i = -7000; i < 7000; ++i) {
    const double a = i * 0.137;
    EXPECT_NEAR(csg::sin_deg(a), std::sin(a * M_PI / 180), 1e-13);
    EXPECT_NEAR(csg::cos_deg(a), std::cos(a * M_PI / 180), 1e-13);
  }
}

TEST(SinDeg, IsNotANumberWhereAnglesAreMeaningless) {
  EXPECT_TRUE(std::isnan(csg::sin_deg(1e300)));
  EXPECT_TRUE(
      std::isnan(csg::cos_deg(std::numeric_limits<double>::infinity())));
}

// OpenSCAD 2021.01: max(floor(fragments / 8) + 1, 2).
TEST(CurveSegmentCount, IsAnEighthOfACircles) {
  EXPECT_EQ(curve_segment_count(10, {.fn = 0, .fa = 12, .fs = 2}), 4);
  EXPECT_EQ(curve_segment_count(10, {.fn = 16, .fa = 12, .fs = 2}), 3);
  EXPECT_EQ(curve_segment_count(10, {.fn = 7, .fa = 12, .fs = 2}), 2);
  EXPECT_EQ(curve_segment_count(-10, {.fn = 100, .fa = 12, .fs = 2}), 2);
}

TEST(FragmentCount, FollowsFnFaFs) {
  EXPECT_EQ(fragment_count(10, {.fn = 0, .fa = 12, .fs = 2}), 30);
  EXPECT_EQ(fragment_count(1, {.fn = 0, .fa = 12, .fs = 2}), 5);
  EXPECT_EQ(fragment_count(3, {.fn = 0, .fa = 12, .fs = 2}), 10);
  EXPECT_EQ(fragment_count(1, {.fn = 7.9, .fa = 12, .fs = 2}), 7);
  EXPECT_EQ(fragment_count(1, {.fn = 1, .fa = 12, .fs = 2}), 3);
  EXPECT_EQ(fragment_count(1e-7, {.fn = 50, .fa = 12, .fs = 2}), 3);
}

// OpenSCAD 2021.01 takes the other one.
TEST(FragmentCount, LeavesOutWhatIsNoNumber) {
  const double nan = std::nan("");
  EXPECT_EQ(fragment_count(10, {.fn = 0, .fa = nan, .fs = 2}), 32);
  EXPECT_EQ(fragment_count(10, {.fn = 0, .fa = 12, .fs = nan}), 30);
  EXPECT_EQ(fragment_count(10, {.fn = 0, .fa = nan, .fs = nan}), 5);
}

// What OpenSCAD 2021.01 makes of them: the fewest slices there may be.
TEST(SliceCount, IsTheLeastWhereNoIntCanHoldIt) {
  csg::LinearExtrudeParams params;
  params.height = 5;
  params.has_twist = true;
  params.twist_deg = 300;
  params.facets = {.fn = 0, .fa = 12, .fs = 0};
  EXPECT_EQ(slice_count(params, 1, 0), 3);
  params.facets = {.fn = 0, .fa = 0, .fs = 2};
  EXPECT_EQ(slice_count(params, 1, 0), 3);
  params.twist_deg = 1e300;
  EXPECT_EQ(slice_count(params, 1, 0), 1);
  csg::LinearExtrudeParams cone;
  cone.height = 5;
  cone.scale = {2, 3};
  cone.facets = {.fn = 0, .fa = 12, .fs = 0};
  EXPECT_EQ(slice_count(cone, 1, 1), 1);
}

TEST(UnitCircle, IsExactlySymmetric) {
  const auto points = unit_circle(24);
  for (std::size_t i = 0; i < 24; ++i) {
    EXPECT_EQ(points[i].x, -points[(i + 12) % 24].x);
    EXPECT_EQ(points[i].x, points[(24 - i) % 24].x);
    EXPECT_EQ(points[i].x, points[(i + 6) % 24].y);
  }
}

}  // namespace
}  // namespace lamina::planar
