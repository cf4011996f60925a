#include "csg/plane/clip.h"

#include <numbers>

#include <gtest/gtest.h>

#include "base/loop_area.h"
#include "csg/limits.h"

namespace lamina::planar {
namespace {

Region shifted(Region region, Vec2 shift) {
  for (Contour& contour : region.contours) {
    for (Vec2& point : contour) point += shift;
  }
  return region;
}

TEST(Clip, AreasAddUp) {
  const Region a = circle(3, 40);
  const Region b = shifted(square({4, 5}, false), {1, -1});
  const Region both[] = {a, b};
  EXPECT_NEAR(area(unite(both)) + area(intersect(both)), area(a) + area(b),
              1e-5);
  EXPECT_NEAR(area(subtract(both)) + area(intersect(both)), area(a), 1e-5);
}

TEST(Clip, AHoleRunsClockwise) {
  const Region operands[] = {square({4, 4}, true), square({2, 2}, true)};
  const Region ring = subtract(operands);
  ASSERT_EQ(ring.contours.size(), 2u);
  EXPECT_EQ(area(ring), 12);
  EXPECT_LT(signed_area(ring.contours[0]) * signed_area(ring.contours[1]), 0);
}

TEST(Clip, WhatIsEnclosedTwiceIsOutside) {
  const Contour contours[] = {{{0, 0}, {4, 0}, {4, 4}, {0, 4}},
                              {{1, 1}, {3, 1}, {3, 3}, {1, 3}}};
  EXPECT_EQ(area(from_contours(contours)), 12);
}

TEST(Clip, WhatWindsTwiceIsInsideByTheOtherRule) {
  const Contour outer = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  const Contour inner = {{1, 1}, {3, 1}, {3, 3}, {1, 3}};
  const Contour turned(inner.rbegin(), inner.rend());
  const auto area_of = [](const Contour& a, const Contour& b) {
    const Contour contours[] = {a, b};
    return area(from_contours(contours, FillRule::kNonZero));
  };
  EXPECT_EQ(area_of(outer, inner), 16);
  EXPECT_EQ(area_of(outer, turned), 12);
}

TEST(Clip, ABowTieFallsIntoTwoTriangles) {
  const Contour bow[] = {{{0, 0}, {2, 2}, {2, 0}, {0, 2}}};
  const Region region = from_contours(bow);
  EXPECT_EQ(region.contours.size(), 2u);
  EXPECT_EQ(area(region), 2);
}

TEST(Clip, DirectionOfAPolygonDoesNotMatter) {
  const Contour clockwise[] = {{{0, 0}, {0, 2}, {2, 2}, {2, 0}}};
  EXPECT_EQ(area(from_contours(clockwise)), 4);
}

TEST(Clip, SubtractingEverythingLeavesNothing) {
  const Region operands[] = {square({1, 1}, true), square({2, 2}, true)};
  EXPECT_TRUE(subtract(operands).is_empty());
}

TEST(Clip, GivesDecimalsBackAsTheyWere) {
  const Region operands[] = {square({2.4, 0.1}, false),
                             square({12.34567891, 0.1}, false)};
  const Region both = unite(operands);
  ASSERT_EQ(both.contours.size(), 1U);
  for (const Vec2 point : both.contours[0]) {
    EXPECT_TRUE(point.x == 0 || point.x == 12.34567891) << point.x;
    EXPECT_TRUE(point.y == 0 || point.y == 0.1) << point.y;
  }
}

TEST(Clip, RefusesCoordinatesBeyondItsRange) {
  const Contour contour[] = {{{0, 0}, {1e12, 0}, {0, 1}}};
  EXPECT_THROW(from_contours(contour), csg::LimitExceeded);
}

TEST(Offset, GrowsByAreaPlusBorderPlusCorners) {
  const Region grown = offset(square({4, 3}, false), 0.5, Join::kRound, 1e-4);
  EXPECT_NEAR(area(grown), 12 + 14 * 0.5 + std::numbers::pi * 0.25, 1e-3);
  EXPECT_NEAR(area(offset(square({4, 3}, false), 0.5, Join::kMiter, 0)), 20,
              1e-6);
  EXPECT_NEAR(area(offset(square({4, 3}, false), -0.5, Join::kRound, 1e-4)), 6,
              1e-6);
}

}  // namespace
}  // namespace lamina::planar
