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
Contour convex_contour(std::mt19937_64& random, std::size_t most = 62) {
  std::uniform_real_distribution<double> unit(0, 1);
  const Vec2 size(1 + 9 * unit(random), 1 + 9 * unit(random));
  std::vector<double> angles;
  for (std::size_t i = 3 + random() % (most - 2); i > 0; --i) {
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

// The greatest amount that leaves something of the contour.
double inradius(const Contour& contour) {
  double low = 0;
  double high = 100;
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    (area_within(contour, middle) > 0 ? low : high) = middle;
  }
  return low;
}

Contour turned(Contour contour, double degrees, Vec2 shift) {
  const double angle = degrees * std::numbers::pi / 180;
  const Vec2 x(std::cos(angle), std::sin(angle));
  for (Vec2& p : contour) p = p.x * x + p.y * left_of(x) + shift;
  return contour;
}

// Each leaves a line or a point when it moves inwards by 1.
std::vector<Contour> contours_of_inradius_1() {
  std::vector<Vec2> slot;
  Contour hexagon;
  for (int i = 0; i < 8; ++i) {
    const double angle = (i + 0.5) * std::numbers::pi / 4;
    const Vec2 spoke =
        Vec2(std::cos(angle), std::sin(angle)) / std::cos(std::numbers::pi / 8);
    slot.push_back(spoke + Vec2(10, 0));
    slot.push_back(spoke - Vec2(10, 0));
  }
  for (int i = 0; i < 6; ++i) {
    const double angle = i * std::numbers::pi / 3;
    hexagon.push_back(Vec2(std::cos(angle), std::sin(angle)) /
                      std::cos(std::numbers::pi / 6));
  }
  return {{{-5, -1}, {5, -1}, {5, 1}, {-5, 1}},
          {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}},
          {{-9, -1}, {7, -1}, {3, 1}, {-2, 1}},
          {{-1, -1}, {3, -1}, {-1, 2}},
          convex_hull(slot).contours.at(0),
          hexagon};
}

TEST(Offset, OfAConvexRegionByItsInradiusIsNothing) {
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> place(-200, 200);
  const std::vector<Contour> contours = contours_of_inradius_1();
  for (int degrees = 0; degrees < 360; ++degrees) {
    for (std::size_t i = 0; i < contours.size(); ++i) {
      SCOPED_TRACE(testing::Message() << i << " turned by " << degrees);
      const Contour contour =
          turned(contours[i], degrees, Vec2(place(random), place(random)));
      const Region region = from_contours({&contour, 1});
      for (const double amount : {1.0, 1 + 1e-7, 1.5}) {
        EXPECT_TRUE(offset(region, -amount, Join::kRound, 1e-4).is_empty());
      }
      for (const double amount : {1 - 1e-6, 1 - 1e-3}) {
        const Region rest = offset(region, -amount, Join::kRound, 1e-4);
        EXPECT_FALSE(rest.is_empty());
        EXPECT_NEAR(area(rest), area_within(contour, amount), 1e-8 * 40);
      }
      // As a hole in a plate.
      Region plate = region;
      std::ranges::reverse(plate.contours.at(0));
      plate.contours.push_back(square({500, 500}, true).contours.at(0));
      EXPECT_EQ(area(offset(plate, 1, Join::kMiter, 1e-4)), 502 * 502);
    }
  }
}

TEST(Offset, OfAConvexRegionByAboutItsInradiusStaysInsideOfAllMovedEdges) {
  std::mt19937_64 random(13);
  for (int trial = 0; trial < 3000; ++trial) {
    const Contour contour = convex_contour(random, 8);
    // Half of them by just that.
    const double excess =
        trial % 2 == 0 ? 0 : std::pow(10, -1 - trial % 10) * (trial % 3 - 1);
    const double amount = inradius(contour) * (1 + excess);
    const Region rest =
        offset(from_contours({&contour, 1}), -amount, Join::kRound, 1e-4);
    EXPECT_NEAR(area(rest), area_within(contour, amount), 1e-6);
    for (const Contour& curve : rest.contours) {
      for (const Vec2 corner : curve) {
        for (std::size_t i = 0; i < contour.size(); ++i) {
          const Vec2 along =
              glm::normalize(contour[(i + 1) % contour.size()] - contour[i]);
          EXPECT_GT(cross(along, corner - contour[i]), amount - 2e-8);
        }
      }
    }
  }
}

// An angle, a fork and a cross.
TEST(Offset, OfWallsByHalfTheirWidthIsNothing) {
  const std::vector<Contour> walls = {
      {{0, 0}, {10, 0}, {10, 2}, {2, 2}, {2, 8}, {0, 8}},
      {{0, 0},
       {10, 0},
       {10, 2},
       {8, 2},
       {8, 10},
       {6, 10},
       {6, 2},
       {2, 2},
       {2, 10},
       {0, 10}},
      {{-1, -5},
       {1, -5},
       {1, -1},
       {5, -1},
       {5, 1},
       {1, 1},
       {1, 5},
       {-1, 5},
       {-1, 1},
       {-5, 1},
       {-5, -1},
       {-1, -1}}};
  for (int degrees = 0; degrees < 360; ++degrees) {
    for (const Contour& wall : walls) {
      const Contour contour = turned(wall, degrees, {13.3, -7.1});
      const Region region = from_contours({&contour, 1});
      EXPECT_TRUE(offset(region, -1, Join::kMiter, 1e-4).is_empty());
      EXPECT_NEAR(area(offset(region, -1 + 1e-6, Join::kMiter, 1e-4)),
                  1e-6 * (area(region) - 4), 2e-7);
    }
  }
}

TEST(Offset, ClosesAGapOfTwiceTheAmount) {
  for (int degrees = 0; degrees < 360; ++degrees) {
    SCOPED_TRACE(degrees);
    Region pair;
    for (const double x : {-4.0, 4.0}) {
      const Contour side{{x - 3, -5}, {x + 3, -5}, {x + 3, 5}, {x - 3, 5}};
      pair.contours.push_back(turned(side, degrees, {31, -7}));
    }
    EXPECT_NEAR(area(offset(pair, 1, Join::kMiter, 1e-4)), 16 * 12, 1e-6);
    EXPECT_NEAR(area(offset(pair, 1 - 1e-6, Join::kMiter, 1e-4)),
                (16 - 4e-6) * (12 - 2e-6), 1e-6);
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
