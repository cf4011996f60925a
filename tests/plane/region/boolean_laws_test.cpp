// The laws of sets for polygons that touch wherever they can.

#include <cmath>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "csg/facets.h"
#include "plane/loop_area.h"
#include "plane/predicates.h"
#include "plane/region/boolean.h"
#include "plane/region/minkowski.h"
#include "tests/plane/region/lattice_walks.h"

namespace lamina::plane {
namespace {

// Twice its height above the line from a to b times their distance: exact here.
double turn(Vec2 a, Vec2 b, Vec2 p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

// Crossings of the half line from p towards +x; p is on no contour.
int winding(const std::vector<Contour>& contours, Vec2 p) {
  int winding = 0;
  for (const Contour& contour : contours) {
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const Vec2 a = contour[i];
      const Vec2 b = contour[(i + 1) % contour.size()];
      if (a.y <= p.y && p.y < b.y && turn(a, b, p) > 0) ++winding;
      if (b.y <= p.y && p.y < a.y && turn(a, b, p) < 0) --winding;
    }
  }
  return winding;
}

// Rows, columns and diagonals cut each square of the lattice into four
// triangles. These points, one in each, are on no line.
std::vector<Vec2> points_off_all_lines() {
  std::vector<Vec2> points;
  for (int x = 0; x < kLatticeSize; ++x) {
    for (int y = 0; y < kLatticeSize; ++y) {
      for (const Vec2 p : {Vec2(0.5, 0.125), Vec2(0.875, 0.5), Vec2(0.5, 0.875),
                           Vec2(0.125, 0.5)}) {
        points.push_back(p + Vec2(x, y));
      }
    }
  }
  return points;
}

Vec2 turned(Vec2 p, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * p.x - s * p.y, s * p.x + c * p.y};
}

// What the region winds around each of the points: 0 or 1.
//
// angle  that the lattice was turned by
std::vector<int> cover(const Region& region, double angle = 0) {
  std::vector<int> windings;
  for (const Vec2 p : points_off_all_lines()) {
    windings.push_back(winding(region.contours, turned(p, angle)));
  }
  return windings;
}

bool edges_cross(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  return orientation(a, b, c) * orientation(a, b, d) < 0 &&
         orientation(c, d, a) * orientation(c, d, b) < 0;
}

bool visits_a_point_twice(const Contour& contour) {
  std::set<std::pair<double, double>> points;
  for (const Vec2 p : contour) points.emplace(p.x, p.y);
  return points.size() < contour.size();
}

std::vector<std::pair<Vec2, Vec2>> edges_of(const Region& region) {
  std::vector<std::pair<Vec2, Vec2>> edges;
  for (const Contour& contour : region.contours) {
    for (std::size_t i = 0; i < contour.size(); ++i) {
      edges.emplace_back(contour[i], contour[(i + 1) % contour.size()]);
    }
  }
  return edges;
}

// All that region.h promises.
void expect_valid(const Region& region) {
  for (const Contour& contour : region.contours) {
    EXPECT_GE(contour.size(), 3U);
    EXPECT_FALSE(visits_a_point_twice(contour));
  }
  const auto edges = edges_of(region);
  for (const auto& [a, b] : edges) {
    for (const auto& [c, d] : edges) EXPECT_FALSE(edges_cross(a, b, c, d));
  }
  for (const int winding : cover(region)) {
    EXPECT_TRUE(winding == 0 || winding == 1) << winding;
  }
}

TEST(PlaneBooleanLaws, AFillRuleSaysWhatIsInside) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const auto contours = lattice_walks(seed);
    const Region odd = from_contours(contours, FillRule::kEvenOdd);
    const Region wound = from_contours(contours, FillRule::kNonZero);
    expect_valid(odd);
    expect_valid(wound);
    std::vector<int> is_odd;
    std::vector<int> is_wound;
    for (const Vec2 p : points_off_all_lines()) {
      const int number = winding(contours, p);
      is_odd.push_back(number % 2 != 0 ? 1 : 0);
      is_wound.push_back(number != 0 ? 1 : 0);
    }
    EXPECT_EQ(cover(odd), is_odd);
    EXPECT_EQ(cover(wound), is_wound);
  }
}

// Now nothing meets but for the rounding.
TEST(PlaneBooleanLaws, AFillRuleSaysSoInAnyDirection) {
  constexpr double kAngle = 0.3;
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    auto contours = lattice_walks(seed);
    for (const FillRule rule : {FillRule::kEvenOdd, FillRule::kNonZero}) {
      const Region straight = from_contours(contours, rule);
      auto tilted = contours;
      for (Contour& contour : tilted) {
        for (Vec2& p : contour) p = turned(p, kAngle);
      }
      const Region region = from_contours(tilted, rule);
      EXPECT_EQ(cover(region, kAngle), cover(straight));
      EXPECT_NEAR(area(region), area(straight), 1e-5);
      for (const Contour& contour : region.contours) {
        EXPECT_FALSE(visits_a_point_twice(contour));
      }
    }
  }
}

TEST(PlaneBooleanLaws, OperatorsAreThoseOfSets) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const Region a = from_contours(lattice_walks(2 * seed));
    const Region b =
        from_contours(lattice_walks(2 * seed + 1), FillRule::kNonZero);
    const Region both[] = {a, b};
    const Region all = unite(both);
    const Region common = intersect(both);
    const Region rest = subtract(both);
    for (const Region& region : {all, common, rest}) expect_valid(region);

    const auto in_a = cover(a);
    const auto in_b = cover(b);
    const auto in_all = cover(all);
    const auto in_common = cover(common);
    const auto in_rest = cover(rest);
    for (std::size_t i = 0; i < in_a.size(); ++i) {
      EXPECT_EQ(in_all[i], in_a[i] | in_b[i]);
      EXPECT_EQ(in_common[i], in_a[i] & in_b[i]);
      EXPECT_EQ(in_rest[i], in_a[i] & ~in_b[i]);
    }
    EXPECT_EQ(area(all) + area(common), area(a) + area(b));
    EXPECT_EQ(area(rest) + area(common), area(a));
  }
}

TEST(PlaneBooleanLaws, WhatARegionIsMadeOfMakesItAgain) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    const Region region = from_contours(lattice_walks(seed));
    for (const FillRule rule : {FillRule::kEvenOdd, FillRule::kNonZero}) {
      const Region again = from_contours(region.contours, rule);
      EXPECT_EQ(cover(again), cover(region));
      EXPECT_EQ(area(again), area(region));
    }
  }
}

TEST(PlaneBooleanLaws, AHoleThatTouchesItsOutlineIsAHole) {
  const Contour contours[] = {{{0, 0}, {8, 0}, {8, 8}, {0, 8}},
                              {{0, 4}, {4, 2}, {6, 4}, {4, 6}}};
  const Region region = from_contours(contours);
  expect_valid(region);
  ASSERT_EQ(region.contours.size(), 2U);
  EXPECT_EQ(area(region), 64 - 12);
  EXPECT_EQ(area(fill(region)), 64);
}

// Four holes that touch in a ring cut out what is between them: the middle is
// an outline of its own, as the inside of an outline less its holes hangs
// together. So it is whichever way the ring is turned.
TEST(PlaneBooleanLaws, ARingOfHolesThatTouchLeavesAnIsland) {
  for (const double angle : {0.0, 0.3, 0.7853981633974483}) {
    SCOPED_TRACE(angle);
    std::vector<Contour> contours = {{{-9, -9}, {9, -9}, {9, 9}, {-9, 9}}};
    for (const Vec2 center :
         {Vec2(3, 0), Vec2(0, 3), Vec2(-3, 0), Vec2(0, -3)}) {
      contours.push_back({center + Vec2(-1.5, -1.5), center + Vec2(1.5, -1.5),
                          center + Vec2(1.5, 1.5), center + Vec2(-1.5, 1.5)});
    }
    for (Contour& contour : contours) {
      for (Vec2& p : contour) p = turned(p, angle);
    }
    const Region region = from_contours(contours);
    EXPECT_NEAR(area(region), 18 * 18 - 4 * 9, 1e-9);
    int outlines = 0;
    for (const Contour& contour : region.contours) {
      outlines += signed_area(contour) > 0;
      EXPECT_FALSE(visits_a_point_twice(contour));
    }
    EXPECT_EQ(outlines, 2);
    EXPECT_EQ(region.contours.size(), 3U);
    EXPECT_NEAR(area(fill(region)), 18 * 18, 1e-9);
  }
}

TEST(PlaneBooleanLaws, PetalsThatMeetInOnePointAreContours) {
  std::vector<Contour> petals;
  for (const Vec2 d : {Vec2(4, 1), Vec2(1, 4), Vec2(-4, 1), Vec2(-1, -4)}) {
    petals.push_back({{0, 0}, d, d + Vec2(-d.y, d.x) / 4.0});
  }
  const Region flower = from_contours(petals);
  expect_valid(flower);
  EXPECT_EQ(flower.contours.size(), petals.size());
  EXPECT_EQ(area(flower), 4 * 17.0 / 8);
}

// Under a second where nothing else runs; a search that compares each vertex
// with each other one meets the time limit of a test.
TEST(PlaneBooleanLaws, HoldForManyVertices) {
  const Region disc = csg::circle(20, 200'000);
  Region moved = disc;
  for (Vec2& p : moved.contours[0]) p += Vec2(5, 3);
  const Region discs[] = {disc, moved};
  EXPECT_NEAR(area(unite(discs)) + area(intersect(discs)), 2 * area(disc),
              1e-4);
}

}  // namespace
}  // namespace lamina::plane
