#include "csg/facets.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "csg/degrees.h"

namespace lamina::csg {
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
  EXPECT_EQ(
      curve_segment_count(10, {.fn = 0, .fa = 12, .fs = 2}, Language::k2021),
      4);
  EXPECT_EQ(
      curve_segment_count(10, {.fn = 16, .fa = 12, .fs = 2}, Language::k2021),
      3);
  EXPECT_EQ(
      curve_segment_count(10, {.fn = 7, .fa = 12, .fs = 2}, Language::k2021),
      2);
  EXPECT_EQ(
      curve_segment_count(-10, {.fn = 100, .fa = 12, .fs = 2}, Language::k2021),
      2);
}

TEST(FragmentCount, FollowsFnFaFs) {
  EXPECT_EQ(fragment_count(10, {.fn = 0, .fa = 12, .fs = 2}, Language::k2021),
            30);
  EXPECT_EQ(fragment_count(1, {.fn = 0, .fa = 12, .fs = 2}, Language::k2021),
            5);
  EXPECT_EQ(fragment_count(3, {.fn = 0, .fa = 12, .fs = 2}, Language::k2021),
            10);
  EXPECT_EQ(fragment_count(1, {.fn = 7.9, .fa = 12, .fs = 2}, Language::k2021),
            7);
  EXPECT_EQ(fragment_count(1, {.fn = 1, .fa = 12, .fs = 2}, Language::k2021),
            3);
  EXPECT_EQ(
      fragment_count(1e-7, {.fn = 50, .fa = 12, .fs = 2}, Language::k2021), 3);
}

TEST(FragmentCount, RoundsUpInNewerDesigns) {
  const csg::Facets by_number{.fn = 7.1};
  EXPECT_EQ(fragment_count(1, by_number, Language::k2026), 8);
  EXPECT_EQ(fragment_count(1, by_number, Language::k2021, 100), 1);
  EXPECT_EQ(fragment_count(1, by_number, Language::k2026, 100), 3);
  const csg::Facets by_size{.fn = 0, .fa = 12, .fs = 2};
  EXPECT_EQ(fragment_count(10, by_size, Language::k2021, 90), 7);
  EXPECT_EQ(fragment_count(10, by_size, Language::k2026, 90), 8);
  // 72 · 5 / 360 is 1, not a little more.
  EXPECT_EQ(fragment_count(1, {.fn = 72}, Language::k2026, 5), 1);
}

// The middle of a side lies r (1 - cos(180° / n)) within the circle.
TEST(FragmentCount, KeepsTheErrorThatIsAskedFor) {
  for (const double r : {0.5, 3.0, 400.0}) {
    for (const double error : {0.5, 0.01, 1e-4}) {
      const csg::Facets facets{.fe = error};
      const int n = fragment_count(r, facets, Language::k2026);
      const auto error_of = [&](int sides) {
        return r * (1 - csg::cos_deg(180.0 / sides));
      };
      EXPECT_TRUE(error_of(n) <= error * (1 + 1e-9) || n == 36000);
      EXPECT_TRUE(n == 5 || error_of(n - 1) > error);
      EXPECT_EQ(fragment_count(r, facets, Language::k2021),
                fragment_count(r, {}, Language::k2021));
    }
  }
}

// OpenSCAD 2021.01 takes the other one.
TEST(FragmentCount, LeavesOutWhatIsNoNumber) {
  const double nan = std::nan("");
  EXPECT_EQ(fragment_count(10, {.fn = 0, .fa = nan, .fs = 2}, Language::k2021),
            32);
  EXPECT_EQ(fragment_count(10, {.fn = 0, .fa = 12, .fs = nan}, Language::k2021),
            30);
  EXPECT_EQ(
      fragment_count(10, {.fn = 0, .fa = nan, .fs = nan}, Language::k2021), 5);
}

// What OpenSCAD 2021.01 makes of them: the fewest slices there may be.
TEST(SliceCount, IsTheLeastWhereNoIntCanHoldIt) {
  csg::LinearExtrudeParams params;
  params.height = 5;
  params.has_twist = true;
  params.twist_deg = 300;
  params.facets = {.fn = 0, .fa = 12, .fs = 0};
  EXPECT_EQ(slice_count(params, 1, 0, Language::k2021), 3);
  params.facets = {.fn = 0, .fa = 0, .fs = 2};
  EXPECT_EQ(slice_count(params, 1, 0, Language::k2021), 3);
  params.twist_deg = 1e300;
  EXPECT_EQ(slice_count(params, 1, 0, Language::k2021), 1);
  csg::LinearExtrudeParams cone;
  cone.height = 5;
  cone.scale = {2, 3};
  cone.facets = {.fn = 0, .fa = 12, .fs = 0};
  EXPECT_EQ(slice_count(cone, 1, 1, Language::k2021), 1);
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
}  // namespace lamina::csg
