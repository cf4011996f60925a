#include "slicer/check/print/pole.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "plane/predicates.h"

namespace lamina::slicer {
namespace {

using std::numbers::pi;

double distance_to_boundary(const plane::Contours& region, Vec2 place) {
  double least = 1e300;
  for (std::size_t i = 0; i < region.loop_count(); ++i) {
    const auto loop = region.loop(i);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      least = std::min(least, distance_to_segment(place, loop[k],
                                                  loop[(k + 1) % loop.size()]));
    }
  }
  return least;
}

Vec2 turned(Vec2 point, double angle) {
  return {std::cos(angle) * point.x - std::sin(angle) * point.y,
          std::sin(angle) * point.x + std::cos(angle) * point.y};
}

plane::Contours loops_of(const std::vector<std::vector<Vec2>>& loops) {
  plane::Contours contours;
  for (const std::vector<Vec2>& loop : loops) contours.add_loop(loop);
  return contours;
}

int winding_around(const plane::Contours& region, Vec2 place) {
  int winding = 0;
  for (std::size_t i = 0; i < region.loop_count(); ++i) {
    winding += winding_number(region.loop(i), place);
  }
  return winding;
}

std::vector<Vec2> circle(double radius, int sides) {
  std::vector<Vec2> loop;
  for (int i = 0; i < sides; ++i) {
    loop.push_back(turned({radius, 0}, 2 * pi * i / sides));
  }
  return loop;
}

// A promise of the header, by closed formulas of the greatest distance.
void expect_pole(const plane::Contours& region, double greatest) {
  const Vec2 place = pole_of(region);
  EXPECT_EQ(winding_around(region, place), 1);
  EXPECT_GE(distance_to_boundary(region, place), 0.8 * greatest * (1 - 1e-6));
}

// The incircle's radius is twice the area over the perimeter.
TEST(PoleOf, IsNearTheIncircleOfSliversHoweverSlender) {
  for (const double width : {10.0, 1.0, 0.1, 1e-2, 1e-3, 1e-4, 1e-5}) {
    for (const double apex : {0.5, 0.0, 0.9}) {
      for (int turn = 0; turn < 12; ++turn) {
        std::vector<Vec2> triangle = {{0, 0}, {width, 0}, {apex * width, 10}};
        const double length = distance(triangle[0], triangle[1]) +
                              distance(triangle[1], triangle[2]) +
                              distance(triangle[2], triangle[0]);
        for (Vec2& point : triangle) point = turned(point, 0.5 + turn);
        expect_pole(loops_of({triangle}), width * 10 / length);
      }
    }
  }
}

TEST(PoleOf, IsInTheMiddleOfThinRings) {
  for (const double width : {1.0, 0.1, 1e-2, 1e-3}) {
    std::vector<Vec2> hole = circle(10 - width, 180);
    std::ranges::reverse(hole);
    // Between two sides, which are parallel.
    const double apart = width * std::cos(pi / 180);
    expect_pole(loops_of({circle(10, 180), hole}), apart / 2);
  }
}

// Chords across its length all miss the head.
TEST(PoleOf, IsInTheHeadOfAPin) {
  std::vector<Vec2> pin = {{0, -1e-3}, {100, -1e-3}};
  for (int i = 0; i < 24; ++i) {
    const double angle = -pi + 1e-3 + (2 * pi - 2e-3) * i / 23;
    pin.push_back(Vec2(101, 0) + turned({1, 0}, angle));
  }
  pin.push_back({0, 1e-3});
  expect_pole(loops_of({pin}), std::cos(pi / 23));
}

}  // namespace
}  // namespace lamina::slicer
