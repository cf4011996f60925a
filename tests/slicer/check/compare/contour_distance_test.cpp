// The Hausdorff distance of contours: known shapes, and points tried one by
// one.

#include "slicer/check/compare/contour_distance.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/contour_checks.h"

namespace lamina::slicer {
namespace {

using plane::Contours;
using support::add_loop;

Contours loop(const std::vector<Vec2>& points) {
  Contours contours;
  add_loop(contours, points);
  return contours;
}

Contours circle(double radius, int corners) {
  std::vector<Vec2> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    points.push_back(radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return loop(points);
}

const Contours kSquare = loop({{0, 0}, {10, 0}, {10, 10}, {0, 10}});

TEST(GreatestDistance, OfItselfIsNothing) {
  EXPECT_EQ(greatest_distance(kSquare, kSquare).distance, 0);
  EXPECT_EQ(greatest_distance({}, {}).distance, 0);
}

TEST(GreatestDistance, OfShiftedSquares) {
  const Contours shifted = loop({{3, 0}, {13, 0}, {13, 10}, {3, 10}});
  const ContourDistance found = greatest_distance(kSquare, shifted);
  EXPECT_DOUBLE_EQ(found.distance, 3);
  const Contours diagonal = loop({{3, 4}, {13, 4}, {13, 14}, {3, 14}});
  EXPECT_DOUBLE_EQ(greatest_distance(kSquare, diagonal).distance, 5);
}

TEST(GreatestDistance, OfCirclesIsTheDifferenceOfTheirRadii) {
  // Corners of the outer one are farthest from the facets of the inner one.
  const int corners = 360;
  EXPECT_NEAR(
      greatest_distance(circle(5, corners), circle(4.9, corners)).distance, 0.1,
      1e-12);
}

TEST(GreatestDistance, FindsTheMiddleOfASlotOfOneOnly) {
  // The middle of the long sides of a slot that only one of them has.
  Contours slotted = loop({{0, 0}, {10, 0}, {10, 10}, {0, 10}});
  add_loop(slotted, {{2, 4.9}, {2, 5.1}, {8, 5.1}, {8, 4.9}});
  const ContourDistance found = greatest_distance(slotted, kSquare);
  EXPECT_NEAR(found.distance, 4.9, 2 * kDistanceResolution);
}

TEST(GreatestDistance, FindsTheMiddleOfAnOpening) {
  // An arrow head into a square: farthest in the middle of the opening.
  const Contours arrow = loop({{0, 0}, {10, 0}, {10, 10}, {5, 2}, {0, 10}});
  const ContourDistance opening = greatest_distance(kSquare, arrow);
  // From (5, 10) to the slanted sides.
  EXPECT_NEAR(opening.distance, 5 * 8 / std::sqrt(89.0),
              2 * kDistanceResolution);
  EXPECT_NEAR(opening.place.x, 5, 1e-6);
  EXPECT_NEAR(opening.place.y, 10, 1e-12);
}

TEST(GreatestDistance, IsInfiniteWhereOneIsMissing) {
  EXPECT_EQ(greatest_distance(kSquare, {}).distance,
            std::numeric_limits<double>::infinity());
  EXPECT_EQ(greatest_distance({}, kSquare).distance,
            std::numeric_limits<double>::infinity());
}

// One way, at points 1/200 of an edge apart.
double tried(const Contours& from, const Contours& to) {
  double greatest = 0;
  for (std::size_t i = 0; i < from.loop_count(); ++i) {
    const auto points = from.loop(i);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Vec2 begin = points[k];
      const Vec2 step = points[(k + 1) % points.size()] - begin;
      for (int part = 0; part < 200; ++part) {
        greatest = std::max(greatest, support::distance_to_edges(
                                          to, begin + part / 200.0 * step));
      }
    }
  }
  return greatest;
}

TEST(GreatestDistance, IsThatOfPointsTriedOneByOne) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-5, 5);
  for (int run = 0; run < 40; ++run) {
    const auto scribble = [&] {
      std::vector<Vec2> points(3 + random() % 30);
      for (Vec2& point : points) {
        point = {coordinate(random), coordinate(random)};
      }
      return loop(points);
    };
    const Contours a = scribble();
    const Contours b = scribble();
    const double expected = std::max(tried(a, b), tried(b, a));
    const double found = greatest_distance(a, b).distance;
    EXPECT_GE(found, expected - 2 * kDistanceResolution);
    EXPECT_LE(found, expected + 0.05);  // between the points that were tried
    EXPECT_NEAR(found, greatest_distance(b, a).distance,
                2 * kDistanceResolution);
  }
}

}  // namespace
}  // namespace lamina::slicer
