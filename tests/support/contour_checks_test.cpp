#include "tests/support/contour_checks.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace lamina::support {
namespace {

using Kind = ContourDefect::Kind;
using plane::Contours;

std::vector<Vec2> square(double x, double y, double side) {
  return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
}

std::vector<Vec2> reversed(const std::vector<Vec2>& points) {
  return {points.rbegin(), points.rend()};
}

Contours contours_of(const std::vector<std::vector<Vec2>>& loops) {
  Contours contours;
  for (const auto& loop : loops) add_loop(contours, loop);
  return contours;
}

std::vector<Vec2> turned(std::vector<Vec2> points, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  for (Vec2& p : points) p = {c * p.x - s * p.y, s * p.x + c * p.y};
  return points;
}

bool has(const Contours& contours, Kind kind) {
  for (const ContourDefect& defect : find_defects(contours)) {
    if (defect.kind == kind) return true;
  }
  return false;
}

// A square with a square hole with a square island, turned so that nothing is
// axis-parallel.
std::vector<std::vector<Vec2>> nested_squares(double angle) {
  return {turned(square(0, 0, 9), angle),
          turned(reversed(square(1, 1, 7)), angle),
          turned(square(2, 2, 5), angle)};
}

TEST(FindDefects, PassesNestedLoops) {
  for (const double angle : {0.0, 0.3, 1.0, 2.5, 4.0}) {
    EXPECT_TRUE(are_sound(contours_of(nested_squares(angle)))) << angle;
  }
}

TEST(FindDefects, PassesNoLoops) { EXPECT_TRUE(are_sound({})); }

TEST(FindDefects, FindsALoopThatRunsTheWrongWay) {
  for (std::size_t wrong = 0; wrong < 3; ++wrong) {
    auto loops = nested_squares(0.3);
    loops[wrong] = reversed(loops[wrong]);
    EXPECT_TRUE(has(contours_of(loops), Kind::kWrongOrientation)) << wrong;
  }
}

TEST(FindDefects, FindsAMissingHoleAroundAnIsland) {
  auto loops = nested_squares(0.3);
  loops.erase(loops.begin() + 1);
  EXPECT_TRUE(has(contours_of(loops), Kind::kWrongOrientation));
}

TEST(FindDefects, FindsCrossingLoops) {
  for (const double angle : {0.0, 0.3, 1.0}) {
    const auto contours = contours_of(
        {turned(square(0, 0, 2), angle), turned(square(1, 1, 2), angle)});
    EXPECT_TRUE(has(contours, Kind::kCrossing)) << angle;
  }
}

TEST(FindDefects, FindsALoopThatCrossesItself) {
  const auto contours = contours_of({{{0, 0}, {2, 2}, {2, 0}, {0, 2.5}}});
  EXPECT_TRUE(has(contours, Kind::kCrossing));
}

TEST(FindDefects, FindsACrossingAsShallowAsTenTimesTheTouchDistance) {
  auto poker = square(2, 0.5, 1);
  poker[0].x = poker[3].x = 2 - 1e-8;
  const auto contours = contours_of({square(0, 0, 2), poker});
  EXPECT_TRUE(has(contours, Kind::kCrossing));
}

TEST(FindDefects, FindsAWallOfNoThicknessBetweenTwoLoops) {
  const auto contours = contours_of({square(0, 0, 2), square(2, 0.5, 1)});
  EXPECT_TRUE(has(contours, Kind::kOverlap));
}

TEST(FindDefects, FindsASpike) {
  const auto contours =
      contours_of({{{0, 0}, {2, 0}, {2, 1}, {3, 1}, {2, 1}, {2, 2}, {0, 2}}});
  EXPECT_FALSE(are_sound(contours));
}

TEST(FindDefects, AllowsLoopsThatTouchInACorner) {
  EXPECT_TRUE(are_sound(contours_of({square(0, 0, 2), square(2, 2, 2)})));
  EXPECT_TRUE(are_sound(contours_of(
      {turned(square(0, 0, 2), 0.3), turned(square(2, 2, 2), 0.3)})));
}

TEST(FindDefects, AllowsACornerInTheMiddleOfALongestEdge) {
  const auto diamond = turned(square(0, 0, std::sqrt(2)), std::numbers::pi / 4);
  auto shifted = diamond;
  for (Vec2& point : shifted) point += Vec2(-1, 1);
  EXPECT_TRUE(
      are_sound(contours_of({{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, shifted})));
}

TEST(FindDefects, FindsALoopThatTouchesItself) {
  const auto contours = contours_of(
      {{{0, 0}, {2, 0}, {2, 2}, {4, 2}, {4, 4}, {2, 4}, {2, 2}, {0, 2}}});
  EXPECT_TRUE(has(contours, Kind::kTouchesItself));
}

TEST(FindDefects, FindsRepeatedPoints) {
  auto loop = square(0, 0, 2);
  loop.insert(loop.begin() + 1, loop[1]);
  EXPECT_TRUE(has(contours_of({loop}), Kind::kRepeatedPoint));
  // The closing pair as well.
  loop = square(0, 0, 2);
  loop.push_back(loop.front());
  EXPECT_TRUE(has(contours_of({loop}), Kind::kRepeatedPoint));
}

TEST(FindDefects, FindsCollinearPoints) {
  auto loop = square(0, 0, 2);
  loop.insert(loop.begin() + 1, {1, 0});
  EXPECT_TRUE(has(contours_of({loop}), Kind::kCollinearPoint));
}

TEST(FindDefects, FindsLoopsWithoutArea) {
  const auto contours = contours_of({{{0, 0}, {1e-5, 0}, {0, 1e-5}}});
  EXPECT_TRUE(has(contours, Kind::kZeroArea));
}

TEST(FindDefects, FindsLoopsOfTwoPoints) {
  EXPECT_TRUE(has(contours_of({{{0, 0}, {1, 1}}}), Kind::kTooFewPoints));
}

TEST(FindDefects, FindsCoordinatesThatAreNoNumbers) {
  auto loop = square(0, 0, 2);
  loop[2].y = std::nan("");
  EXPECT_TRUE(has(contours_of({loop}), Kind::kNotFinite));
}

TEST(FindDefects, SaysWhere) {
  const auto defects =
      find_defects(contours_of({square(0, 0, 2), square(1, 1, 2)}));
  ASSERT_FALSE(defects.empty());
  EXPECT_NE(defects[0].message.find("crosses loop"), std::string::npos)
      << defects[0].message;
  EXPECT_NEAR(defects[0].place.x + defects[0].place.y, 3, 1e-9);
}

// Concentric rings of many facets: 400,000 edges take seconds only if the grid
// does its work.
TEST(FindDefects, HandlesLargeLayers) {
  Contours contours;
  const auto circle = [](double radius, int facets) {
    std::vector<Vec2> points;
    for (int i = 0; i < facets; ++i) {
      const double angle = 2 * std::numbers::pi * i / facets;
      points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    return points;
  };
  for (int i = 0; i < 200; ++i) {
    const auto loop = circle(10 - 0.02 * i, 1000);
    add_loop(contours, i % 2 == 0 ? loop : reversed(loop));
  }
  for (int i = 0; i < 50'000; ++i) {
    const int row = i / 250;
    add_loop(contours, square(12 + i % 250, row, 0.9));
  }
  EXPECT_TRUE(are_sound(contours));
  EXPECT_EQ(count_loops(contours), (LoopCounts{50'100, 100}));

  // One point of 400,000 moved across its neighbour ring.
  contours.points[150'010] *= 1.005;
  EXPECT_TRUE(has(contours, Kind::kCrossing));
}

TEST(WindingNumber, IsOneInTheSolidOfNestedLoops) {
  for (const double angle : {0.0, 0.3, 2.0}) {
    const auto contours = contours_of(nested_squares(angle));
    const double places[] = {-1, 0.5, 1.5, 4.5, 7.5, 8.5, 9.5};
    const int expected[] = {0, 1, 0, 1, 0, 1, 0};
    for (std::size_t i = 0; i < std::size(places); ++i) {
      const Vec2 point = turned({{places[i], 4.4}}, angle)[0];
      EXPECT_EQ(winding_number(contours, point), expected[i]);
      EXPECT_EQ(contains(contours, point), expected[i] == 1);
    }
  }
}

TEST(TotalArea, SubtractsHoles) {
  EXPECT_NEAR(total_area(contours_of(nested_squares(0.3))), 81 - 49 + 25,
              1e-12);
  EXPECT_NEAR(total_perimeter(contours_of(nested_squares(0.3))),
              4 * (9 + 7 + 5), 1e-12);
}

TEST(DistanceToEdges, IsThatOfTheNearestEdge) {
  const auto contours = contours_of(nested_squares(0));
  EXPECT_DOUBLE_EQ(distance_to_edges(contours, {4.5, 1.25}), 0.25);
  EXPECT_DOUBLE_EQ(distance_to_edges(contours, {12, 13}), 5);
}

TEST(GreatestDistance, SeesBothDirections) {
  const auto one = contours_of({square(0, 0, 1)});
  const auto two = contours_of({square(0, 0, 1), square(3, 0, 1)});
  EXPECT_EQ(greatest_distance(one, one), 0);
  EXPECT_DOUBLE_EQ(greatest_distance(one, two), 3);
  EXPECT_DOUBLE_EQ(greatest_distance(two, one), 3);
  EXPECT_EQ(greatest_distance({}, {}), 0);
  EXPECT_TRUE(std::isinf(greatest_distance(one, {})));
}

}  // namespace
}  // namespace lamina::support
