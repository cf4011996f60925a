#include "plane/region/boolean.h"

#include <gtest/gtest.h>

#include "csg/facets.h"
#include "csg/limits.h"
#include "plane/loop_area.h"

namespace lamina::plane {
namespace {

Region shifted(Region region, Vec2 shift) {
  for (Contour& contour : region.contours) {
    for (Vec2& point : contour) point += shift;
  }
  return region;
}

TEST(PlaneBoolean, AreasAddUp) {
  const Region a = csg::circle(3, 40);
  const Region b = shifted(csg::square({4, 5}, false), {1, -1});
  const Region both[] = {a, b};
  EXPECT_NEAR(area(unite(both)) + area(intersect(both)), area(a) + area(b),
              1e-5);
  EXPECT_NEAR(area(subtract(both)) + area(intersect(both)), area(a), 1e-5);
}

TEST(PlaneBoolean, AHoleRunsClockwise) {
  const Region operands[] = {csg::square({4, 4}, true),
                             csg::square({2, 2}, true)};
  const Region ring = subtract(operands);
  ASSERT_EQ(ring.contours.size(), 2u);
  EXPECT_EQ(area(ring), 12);
  EXPECT_LT(signed_area(ring.contours[0]) * signed_area(ring.contours[1]), 0);
}

TEST(PlaneBoolean, WhatIsEnclosedTwiceIsOutside) {
  const Contour contours[] = {{{0, 0}, {4, 0}, {4, 4}, {0, 4}},
                              {{1, 1}, {3, 1}, {3, 3}, {1, 3}}};
  EXPECT_EQ(area(from_contours(contours)), 12);
}

TEST(PlaneBoolean, WhatWindsTwiceIsInsideByTheOtherRule) {
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

TEST(PlaneBoolean, ABowTieFallsIntoTwoTriangles) {
  const Contour bow[] = {{{0, 0}, {2, 2}, {2, 0}, {0, 2}}};
  const Region region = from_contours(bow);
  EXPECT_EQ(region.contours.size(), 2u);
  EXPECT_EQ(area(region), 2);
}

// So far from the origin that a crossing 0.5 mm from the end of a steep edge
// has the end's x.
TEST(PlaneBoolean, ASteepEdgeCrossesNearItsEnd) {
  const Vec2 end(329339.89617841673, 989035);
  const double crossing = -52.0 * 26 / 2946;
  const double small = 26 * -crossing / 2;
  const double large = (4000 + crossing) * 2920 / 2;
  for (const double dx : {1.5e-9, 1e-8, 1e-7}) {
    for (const Vec2 mirror :
         {Vec2(1, 1), Vec2(-1, 1), Vec2(1, -1), Vec2(-1, -1)}) {
      Contour contour = {{0, 0}, {-26, 0}, {2920, -52}, {dx, -4000}};
      for (Vec2& p : contour) p = end + mirror * p;
      const Region region = from_contours({&contour, 1}, FillRule::kNonZero);
      EXPECT_EQ(region.contours.size(), 2U);
      EXPECT_NEAR(area(region), small + large, 1e-3);
    }
  }
}

TEST(PlaneBoolean, DirectionOfAPolygonDoesNotMatter) {
  const Contour clockwise[] = {{{0, 0}, {0, 2}, {2, 2}, {2, 0}}};
  EXPECT_EQ(area(from_contours(clockwise)), 4);
}

TEST(PlaneBoolean, SubtractingEverythingLeavesNothing) {
  const Region operands[] = {csg::square({1, 1}, true),
                             csg::square({2, 2}, true)};
  EXPECT_TRUE(subtract(operands).is_empty());
}

TEST(PlaneBoolean, GivesDecimalsBackAsTheyWere) {
  const Region operands[] = {csg::square({2.4, 0.1}, false),
                             csg::square({12.34567891, 0.1}, false)};
  const Region both = unite(operands);
  ASSERT_EQ(both.contours.size(), 1U);
  for (const Vec2 point : both.contours[0]) {
    EXPECT_TRUE(point.x == 0 || point.x == 12.34567891) << point.x;
    EXPECT_TRUE(point.y == 0 || point.y == 0.1) << point.y;
  }
}

// A needle of 1.45 x 0.0075 mm; its tip below -3.75 has 7e-10 mm².
TEST(PlaneBoolean, KeepsTheTipOfANeedle) {
  const Region needle{{{{1.9843035783747469, -3.7504559383720459},
                        {1.1388704966606291, -2.5662761646500027},
                        {1.1313480052243756, -2.5672093259432893}}}};
  for (const double y : {-3.0, -3.74, -3.75, -3.7504}) {
    const Region below{{{{1, -5}, {2, -5}, {2, y}, {1, y}}}};
    const Region operands[] = {needle, below};
    const Region tip = intersect(operands);
    EXPECT_GT(area(tip), 0);
    EXPECT_NEAR(area(subtract(operands)) + area(tip), area(needle), 1e-15);
    const Region rest[] = {needle, tip};
    const Region stump = subtract(rest);
    ASSERT_EQ(stump.contours.size(), 1U);
    for (const Vec2 p : stump.contours[0]) EXPECT_GE(p.y, y - 1e-9);
  }
}

TEST(PlaneBoolean, RefusesCoordinatesBeyondItsRange) {
  const Contour contour[] = {{{0, 0}, {1e12, 0}, {0, 1}}};
  EXPECT_THROW(from_contours(contour), LimitExceeded);
}

TEST(PlaneBoolean, RefusesMoreCornersThanMemoryHolds) {
  constexpr auto kMost = static_cast<std::size_t>(kMostCorners);
  EXPECT_NO_THROW(require_corners(kMost));
  EXPECT_THROW(require_corners(kMost + 1), LimitExceeded);
}

}  // namespace
}  // namespace lamina::plane
