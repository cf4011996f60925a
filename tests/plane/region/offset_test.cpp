#include "plane/region/offset.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "csg/facets.h"
#include "plane/predicates.h"
#include "plane/region/boolean.h"

namespace lamina::plane {
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
      plate.contours.push_back(csg::square({500, 500}, true).contours.at(0));
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
  const Region grown =
      offset(csg::square({4, 3}, false), 0.5, Join::kRound, 1e-4);
  EXPECT_NEAR(area(grown), 12 + 14 * 0.5 + std::numbers::pi * 0.25, 1e-3);
  EXPECT_NEAR(area(offset(csg::square({4, 3}, false), 0.5, Join::kMiter, 0)),
              20, 1e-6);
  EXPECT_NEAR(
      area(offset(csg::square({4, 3}, false), -0.5, Join::kRound, 1e-4)), 6,
      1e-6);
}

// Teeth as wide as the gaps between them, on a bar.
Contour comb(int teeth, double pitch, double height, double bar) {
  Contour contour;
  for (int i = 0; i < teeth; ++i) {
    contour.emplace_back(i * pitch, 0);
    contour.emplace_back(i * pitch, height);
    contour.emplace_back((i + 0.5) * pitch, height);
    contour.emplace_back((i + 0.5) * pitch, 0);
  }
  contour.emplace_back((teeth - 0.5) * pitch, -bar);
  contour.emplace_back(0, -bar);
  std::ranges::reverse(contour);
  return contour;
}

// Each strip of 40,000 edges overlaps thousands of others.
TEST(Offset, OfAFineCombIsThatOfItsBarOrOfAll) {
  constexpr double kWidth = 100 - 0.0025;
  const Contour contour = comb(20000, 0.005, 10, 50);
  const Region region = from_contours({&contour, 1});
  const Region grown = offset(region, 15, Join::kMiter, 1e-3);
  ASSERT_EQ(grown.contours.size(), 1U);
  EXPECT_EQ(grown.contours[0].size(), 4U);
  EXPECT_NEAR(area(grown), (kWidth + 30) * 90, 1e-5);
  const Region less = offset(region, -15, Join::kMiter, 1e-3);
  ASSERT_EQ(less.contours.size(), 1U);
  EXPECT_EQ(less.contours[0].size(), 4U);
  EXPECT_NEAR(area(less), (kWidth - 30) * 20, 1e-5);
}

TEST(Offset, OutAndInClosesGaps) {
  const Contour contour = comb(2000, 0.05, 10, 50);
  const Region closed =
      offset(offset(from_contours({&contour, 1}), 3, Join::kMiter, 1e-3), -3,
             Join::kMiter, 1e-3);
  ASSERT_EQ(closed.contours.size(), 1U);
  EXPECT_NEAR(area(closed), (100 - 0.025) * 60, 1e-5);
}

// A circle whose radius is noise.
Contour noisy_circle(std::mt19937_64& random, int corners) {
  std::uniform_real_distribution<double> radius(8, 10);
  Contour contour;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    contour.push_back(radius(random) * Vec2(std::cos(angle), std::sin(angle)));
  }
  return contour;
}

double distance_to_edge(Vec2 point, Vec2 begin, Vec2 end) {
  const Vec2 along = end - begin;
  const double length = glm::dot(along, along);
  const double share =
      length == 0 ? 0
                  : std::clamp(glm::dot(point - begin, along) / length, 0., 1.);
  return glm::distance(point, begin + along * share);
}

double distance_to_path(Vec2 point, const Contour& path, bool is_closed) {
  double distance = glm::distance(point, path[0]);
  for (std::size_t i = is_closed ? 0 : 1; i < path.size(); ++i) {
    const Vec2 before = path[i == 0 ? path.size() - 1 : i - 1];
    distance = std::min(distance, distance_to_edge(point, before, path[i]));
  }
  return distance;
}

bool contains(const Region& region, Vec2 point) {
  int winding = 0;
  for (const Contour& contour : region.contours) {
    for (std::size_t i = 0; i < contour.size(); ++i) {
      winding += crossing(contour[i], contour[(i + 1) % contour.size()], point);
    }
  }
  return winding > 0;
}

// Around fine outlines that move far, and coarse ones that do not.
TEST(Offset, HoldsWhatIsNearer) {
  constexpr double kTolerance = 1e-4;
  std::mt19937_64 random(14);
  std::uniform_real_distribution<double> place(-13, 13);
  for (const int corners : {12, 100, 1000}) {
    for (const double amount : {-3.0, -0.1, 0.01, 0.5, 3.0}) {
      const Contour contour = noisy_circle(random, corners);
      const Region region = from_contours({&contour, 1});
      const Region moved = offset(region, amount, Join::kRound, kTolerance);
      for (int i = 0; i < 300; ++i) {
        const Vec2 point(place(random), place(random));
        const double depth = distance_to_path(point, contour, true) *
                             (contains(region, point) ? 1 : -1);
        if (std::abs(depth + amount) < 3 * kTolerance) continue;
        EXPECT_EQ(contains(moved, point), depth + amount > 0)
            << corners << " corners by " << amount << ", at " << point.x << ' '
            << point.y;
      }
    }
  }
}

TEST(Offset, IsTheSameWhereverTheContourBegins) {
  std::mt19937_64 random(15);
  Contour contour = noisy_circle(random, 1000);
  for (const double amount : {-2.0, 2.0}) {
    const auto moved = [&] {
      return offset({{contour}}, amount, Join::kBevel, 1e-3);
    };
    const Region before = moved();
    for (const int shift : {1, 7, 500}) {
      std::rotate(contour.begin(), contour.begin() + shift, contour.end());
      const Region both[] = {before, moved()};
      EXPECT_NEAR(area(unite(both)), area(intersect(both)), 1e-5);
    }
  }
}

double area_of_stroke(const Contour& path, Join join, Cap cap) {
  return area(stroke(path, 2, join, cap, 1e-6));
}

TEST(Stroke, OfALineHasItsCaps) {
  for (int degrees = 0; degrees < 360; degrees += 7) {
    const Contour line = turned({{0, 0}, {10, 0}}, degrees, {3, -7});
    EXPECT_NEAR(area_of_stroke(line, Join::kMiter, Cap::kButt), 20, 1e-6);
    EXPECT_NEAR(area_of_stroke(line, Join::kMiter, Cap::kSquare), 24, 1e-6);
    EXPECT_NEAR(area_of_stroke(line, Join::kMiter, Cap::kRound),
                20 + std::numbers::pi, 1e-5);
  }
}

TEST(Stroke, OfAnAngleHasItsJoin) {
  const Contour angle = {{0, 0}, {10, 0}, {10, 10}};
  const double arms = 40 - 1;
  EXPECT_NEAR(area_of_stroke(angle, Join::kMiter, Cap::kButt), arms + 1, 1e-6);
  EXPECT_NEAR(area_of_stroke(angle, Join::kRound, Cap::kButt),
              arms + std::numbers::pi / 4, 1e-5);
  // Half a width from the corner.
  const double bevel = 1 - std::pow(std::numbers::sqrt2 - 1, 2);
  EXPECT_NEAR(area_of_stroke(angle, Join::kBevel, Cap::kButt), arms + bevel,
              1e-6);
  // A miter of more than two half widths is cut as that one is.
  const Contour sharp = {{0, 0}, {10, 0}, {0, 1}};
  EXPECT_EQ(area_of_stroke(sharp, Join::kMiter, Cap::kButt),
            area_of_stroke(sharp, Join::kBevel, Cap::kButt));
}

TEST(Stroke, OfACircleIsARing) {
  Contour path;
  for (int i = 0; i <= 10000; ++i) {
    const double angle = 2 * std::numbers::pi * i / 10000;
    path.emplace_back(5 * std::cos(angle), 5 * std::sin(angle));
  }
  for (const Join join : {Join::kRound, Join::kMiter, Join::kBevel}) {
    EXPECT_NEAR(area_of_stroke(path, join, Cap::kRound), std::numbers::pi * 20,
                1e-4);
  }
}

TEST(Stroke, OfAPointIsADotAndOfNothingNothing) {
  for (const Contour& path :
       {Contour{{3, 4}}, Contour{{3, 4}, {3, 4}, {3, 4}}}) {
    for (const Cap cap : {Cap::kButt, Cap::kRound, Cap::kSquare}) {
      EXPECT_NEAR(area_of_stroke(path, Join::kRound, cap), std::numbers::pi,
                  1e-5);
      EXPECT_NEAR(area_of_stroke(path, Join::kMiter, cap), 4, 1e-6);
    }
  }
  EXPECT_TRUE(stroke({}, 2, Join::kRound, Cap::kRound, 1e-3).is_empty());
  const Contour line = {{0, 0}, {10, 0}};
  EXPECT_TRUE(stroke(line, 0, Join::kRound, Cap::kRound, 1e-3).is_empty());
}

// There and back.
TEST(Stroke, OfAPathThatTurnsBackHasAJoinThere) {
  const Contour path = {{0, 0}, {10, 0}, {4, 0}};
  EXPECT_NEAR(area_of_stroke(path, Join::kRound, Cap::kButt),
              20 + std::numbers::pi / 2, 1e-5);
  EXPECT_NEAR(area_of_stroke(path, Join::kMiter, Cap::kButt), 22, 1e-6);
}

TEST(Stroke, HoldsWhatIsNearer) {
  constexpr double kTolerance = 1e-4;
  std::mt19937_64 random(16);
  std::uniform_real_distribution<double> place(0, 20);
  for (const int corners : {5, 40, 1000}) {
    for (const double width : {0.1, 1.0, 5.0}) {
      // Every other path comes back over itself.
      for (const bool comes_back : {false, true}) {
        Contour path;
        for (int i = 0; i < corners; ++i) {
          const Vec2 step(place(random) - 10, place(random) - 10);
          path.push_back(i == 0 ? Vec2(10, 10)
                                : path.back() + step / std::sqrt(corners));
        }
        if (comes_back) path.insert(path.end(), path.rbegin(), path.rend());
        const Region pen =
            stroke(path, width, Join::kRound, Cap::kRound, kTolerance);
        for (int i = 0; i < 200; ++i) {
          const Vec2 point(place(random), place(random));
          const double distance = distance_to_path(point, path, false);
          if (std::abs(distance - width / 2) < 3 * kTolerance) continue;
          EXPECT_EQ(contains(pen, point), distance < width / 2)
              << corners << " corners, " << width << " wide, at " << point.x
              << ' ' << point.y;
        }
      }
    }
  }
}

// Two corners of the tip are one but for rounding; one of them stays.
TEST(Stroke, KeepsTheTipsOfGaps) {
  const Contour path = {
      {160, 20},  {40, 40},  {160, 20},  {60, 80},  {100, 140}, {90, 50},
      {170, 120}, {60, 170}, {100, 150}, {70, 20},  {90, 50},   {160, 60},
      {80, 40},   {180, 90}, {60, 190},  {40, 190}, {80, 120},  {140, 140},
      {80, 90},   {0, 80},   {130, 110}, {0, 60}};
  Contour back = path;
  back.insert(back.end(), path.rbegin(), path.rend());
  EXPECT_NEAR(area(stroke(back, 1, Join::kRound, Cap::kRound, 2.5e-5)),
              area(stroke(path, 1, Join::kRound, Cap::kRound, 2.5e-5)), 1e-3);
}

// 40,000 strokes that overlap thousands of others.
TEST(Stroke, OfAFineMeanderIsARectangle) {
  constexpr int kTurns = 20000;
  constexpr double kPitch = 0.0025;
  Contour path;
  for (int i = 0; i < kTurns; ++i) {
    path.emplace_back(i * kPitch, i % 2 == 0 ? 0 : 10);
    path.emplace_back(i * kPitch, i % 2 == 0 ? 10 : 0);
  }
  const Region pen = stroke(path, 20, Join::kMiter, Cap::kSquare, 1e-3);
  ASSERT_EQ(pen.contours.size(), 1U);
  EXPECT_NEAR(area(pen), ((kTurns - 1) * kPitch + 20) * 30, 1e-5);
}

// An edge shorter than a tie may go anywhere, back or across its neighbours.
TEST(Offset, EdgesShorterThanATieMakeNoCornersOfTheirOwn) {
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> unit(-1, 1);
  const std::vector<Contour> contours = {
      {{0, 0}, {10, 0}, {10, 10}, {0, 10}},
      {{0, 0}, {10, 0}, {10, 4}, {6, 4}, {6, 10}, {0, 10}}};
  for (int trial = 0; trial < 200; ++trial) {
    SCOPED_TRACE(trial);
    const Contour contour = turned(contours[trial % 2], 5.0 * (trial % 72),
                                   1e4 * Vec2(unit(random), unit(random)));
    const double size = 6e-7 * std::pow(10, 2 * unit(random) - 2);
    Contour doubled;
    for (const Vec2 corner : contour) {
      doubled.push_back(corner);
      doubled.push_back(corner + size * Vec2(unit(random), unit(random)));
    }
    for (const Join join : {Join::kRound, Join::kMiter, Join::kBevel}) {
      for (const double amount : {1.0, -1.0}) {
        EXPECT_NEAR(
            area(offset(from_contours({&doubled, 1}), amount, join, 1e-3)),
            area(offset(from_contours({&contour, 1}), amount, join, 1e-3)),
            1e-4);
      }
    }
  }
}

TEST(Offset, SliversThinnerThanATieAreNotLost) {
  for (const double width : {1e-7, 5e-7, 2e-6}) {
    const Region sliver = csg::square({10, width}, false);
    EXPECT_NEAR(area(offset(sliver, 1, Join::kMiter, 1e-3)), 12 * 2, 1e-4);
    EXPECT_NEAR(area(offset(sliver, 1, Join::kRound, 1e-6)),
                20 + std::numbers::pi, 1e-4);
    EXPECT_TRUE(offset(sliver, -1, Join::kMiter, 1e-3).is_empty());
  }
}

}  // namespace
}  // namespace lamina::plane
