#include "csg/plane/offset.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "base/plane.h"
#include "csg/plane/boolean.h"

namespace lamina::planar {
namespace {

// Counter-clockwise, on an ellipse; some edges are very short.
Contour convex_contour(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const Vec2 size(1 + 9 * unit(random), 1 + 9 * unit(random));
  std::vector<double> angles;
  for (std::size_t i = 3 + random() % 60; i > 0; --i) {
    angles.push_back(2 * std::numbers::pi * unit(random));
  }
  std::ranges::sort(angles);
  Contour contour;
  for (const double angle : angles) {
    contour.push_back(size * Vec2(std::cos(angle), std::sin(angle)));
  }
  return contour;
}

// What is left of the contour `amount` inside of all of its edges, one cut
// after the other (Sutherland and Hodgman 1974).
double area_within(const Contour& contour, double amount) {
  Contour left = contour;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const Vec2 along =
        glm::normalize(contour[(i + 1) % contour.size()] - contour[i]);
    const auto depth = [&](Vec2 p) {
      return cross(along, p - contour[i]) - amount;
    };
    Contour cut;
    for (std::size_t k = 0; k < left.size(); ++k) {
      const Vec2 a = left[k];
      const Vec2 b = left[(k + 1) % left.size()];
      if (depth(a) >= 0) cut.push_back(a);
      if ((depth(a) >= 0) != (depth(b) >= 0)) {
        cut.push_back(a + (b - a) * (depth(a) / (depth(a) - depth(b))));
      }
    }
    left = cut;
  }
  double doubled = 0;
  for (std::size_t i = 0; i < left.size(); ++i) {
    doubled += cross(left[i], left[(i + 1) % left.size()]);
  }
  return doubled / 2;
}

TEST(Offset, AConvexRegionKeepsWhatIsInsideOfAllMovedEdges) {
  std::mt19937_64 random(11);
  for (int trial = 0; trial < 300; ++trial) {
    const Contour contour = convex_contour(random);
    const double amount = 0.01 * std::pow(600.0, (trial % 30) / 29.0);
    const double within = area_within(contour, amount);
    EXPECT_NEAR(
        area(offset(from_contours({&contour, 1}), -amount, Join::kRound, 1e-4)),
        within, 1e-6)
        << contour.size() << " corners, by " << amount;
    // As a hole in a plate.
    Region plate = from_contours({&contour, 1});
    plate.contours.front() = {contour.rbegin(), contour.rend()};
    plate.contours.push_back({{-20, -20}, {20, -20}, {20, 20}, {-20, 20}});
    const double side = 40 + 2 * amount;
    EXPECT_NEAR(area(offset(plate, amount, Join::kMiter, 1e-4)),
                side * side - within, 1e-5);
  }
}

TEST(Offset, ACircleThatShrinksBeyondItsCentreIsNothing) {
  Contour circle;
  for (int i = 0; i < 1000; ++i) {
    const double angle = 2 * std::numbers::pi * i / 1000;
    circle.push_back(5.0 * Vec2(std::cos(angle), std::sin(angle)));
  }
  const Region region = from_contours({&circle, 1});
  EXPECT_EQ(area(offset(region, -5.1, Join::kRound, 1e-4)), 0);
  EXPECT_NEAR(area(offset(region, -4.9, Join::kRound, 1e-4)),
              std::numbers::pi * 0.01, 1e-4);
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
