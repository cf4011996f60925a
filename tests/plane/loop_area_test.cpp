#include "plane/loop_area.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace lamina {
namespace {

using Loop = std::vector<Vec2>;

Loop regular_polygon(int n, double radius, Vec2 centre) {
  Loop loop;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    loop.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return loop;
}

TEST(SignedArea, FollowsTheClosedFormulaOfRegularPolygons) {
  for (const int n : {3, 4, 5, 17, 360}) {
    const Loop loop = regular_polygon(n, 2, {5, -7});
    const double area = 2.0 * n * std::sin(2 * std::numbers::pi / n);
    EXPECT_NEAR(signed_area(loop), area, 1e-12);
    Loop reversed(loop.rbegin(), loop.rend());
    EXPECT_NEAR(signed_area(reversed), -area, 1e-12);
  }
}

TEST(SignedArea, IsTheSameWithTheFirstPointRepeated) {
  Loop loop = {{0, 0}, {4, 0}, {4, 3}};
  EXPECT_EQ(signed_area(loop), 6);
  loop.push_back(loop.front());
  EXPECT_EQ(signed_area(loop), 6);
}

// Up the diagonal and back one to its left: products of coordinates take all 53
// bits of a double, the area almost none.
TEST(SliverArea, IsExactForSliversOfWholeNumbers) {
  constexpr double kStep = 0x1p20;
  Loop loop;
  for (int i = 0; i <= 100; ++i) loop.emplace_back(i * kStep + 1, i * kStep);
  for (int i = 100; i >= 0; --i) loop.emplace_back(i * kStep, i * kStep);
  EXPECT_EQ(sliver_area(loop), 100 * kStep);
  const Loop reversed(loop.rbegin(), loop.rend());
  EXPECT_EQ(sliver_area(reversed), -100 * kStep);
}

// Products of coordinates would have lost all of it.
TEST(SignedArea, KeepsItsDigitsFarFromTheOrigin) {
  const Vec2 far(0x1p40, -0x1p41);
  EXPECT_EQ(signed_area(Loop{far, far + Vec2(1, 0), far + Vec2(1, 1)}), 0.5);
}

TEST(SignedArea, IsNoneOfDegenerateLoops) {
  EXPECT_EQ(signed_area({}), 0);
  EXPECT_EQ(signed_area(Loop{{3, 4}}), 0);
  EXPECT_EQ(signed_area(Loop{{3, 4}, {5, 6}}), 0);
  EXPECT_EQ(signed_area(Loop{{0, 0}, {1, 2}, {2, 4}, {3, 6}}), 0);
}

// A figure of eight: the halves cancel.
TEST(SignedArea, CountsALoopThatCrossesItselfByItsWinding) {
  EXPECT_EQ(signed_area(Loop{{0, 0}, {2, 2}, {2, 0}, {0, 2}}), 0);
}

TEST(Perimeter, GoesBackToTheFirstPoint) {
  Loop loop = {{0, 0}, {4, 0}, {4, 3}};
  EXPECT_EQ(perimeter(loop), 12);
  loop.push_back(loop.front());
  EXPECT_EQ(perimeter(loop), 12);
  EXPECT_EQ(perimeter({}), 0);
}

TEST(GreatestCoordinate, LooksInAllFourDirections) {
  EXPECT_EQ(greatest_coordinate({}), 0);
  EXPECT_EQ(greatest_coordinate(Loop{{1, 2}, {-5, 3}}), 5);
  EXPECT_EQ(greatest_coordinate(Loop{{1, 2}, {4, -6}}), 6);
  EXPECT_EQ(greatest_coordinate(Loop{{7, 2}}), 7);
  EXPECT_EQ(greatest_coordinate(Loop{{1, 8}}), 8);
}

}  // namespace
}  // namespace lamina
