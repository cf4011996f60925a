#include "plane/region/region.h"

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "plane/predicates.h"

namespace lamina::plane {
namespace {

TEST(PlanarHull, OfASquareWithPointsInsideAndOnItsSidesIsTheSquare) {
  const Region hull =
      convex_hull({{1, 1}, {0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0}, {2, 0}});
  EXPECT_EQ(hull, (Region{{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}}}));
}

TEST(PlanarHull, OfPointsOnALineIsNothing) {
  EXPECT_TRUE(convex_hull({}).is_empty());
  EXPECT_TRUE(convex_hull({{1, 2}}).is_empty());
  EXPECT_TRUE(convex_hull({{1, 2}, {1, 2}, {3, 4}, {2, 3}}).is_empty());
}

// 0.1, 0.2 and 0.3 are not where they seem: exact decisions notice.
TEST(PlanarHull, OfRandomPointsIsStrictlyConvexAndHoldsThemAll) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> tenth(0, 30);
  for (int round = 0; round < 200; ++round) {
    std::vector<Vec2> points;
    points.reserve(40);
    for (int i = 0; i < 40; ++i) {
      points.emplace_back(tenth(random) * 0.1, tenth(random) * 0.1);
    }
    const Contour hull = convex_hull(points).contours.at(0);
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Vec2 a = hull[i];
      const Vec2 b = hull[(i + 1) % hull.size()];
      EXPECT_EQ(orientation(a, b, hull[(i + 2) % hull.size()]), 1);
      for (const Vec2 point : points) EXPECT_GE(orientation(a, b, point), 0);
    }
  }
}

}  // namespace
}  // namespace lamina::plane
