// Areas of two regions: closed formulas, laws, and the clipper as a second
// opinion.

#include "plane/sweep/region_areas.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "plane/region/boolean.h"
#include "plane/region/region.h"
#include "tests/support/contour_checks.h"

namespace lamina::plane {
namespace {

using support::add_loop;

Contours rectangle(Vec2 low, Vec2 high) {
  Contours contours;
  add_loop(contours, {low, {high.x, low.y}, high, {low.x, high.y}});
  return contours;
}

Contours polygon(Vec2 middle, double radius, int corners, double turn) {
  std::vector<Vec2> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = turn + 2 * std::numbers::pi * i / corners;
    points.push_back(middle + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  Contours contours;
  add_loop(contours, points);
  return contours;
}

double difference(const RegionAreas& areas) {
  return areas.only_a + areas.only_b;
}

TEST(MeasureRegions, OfShiftedSquares) {
  const Contours square = rectangle({0, 0}, {10, 10});
  for (const Vec2 shift : {Vec2(1e-7, 0), Vec2(0.3, 0), Vec2(0, -0.2),
                           Vec2(2, 3), Vec2(10, 0), Vec2(50, 50)}) {
    const RegionAreas areas =
        measure_regions(square, rectangle(shift, shift + Vec2(10)));
    const double both = std::max(10 - std::abs(shift.x), 0.0) *
                        std::max(10 - std::abs(shift.y), 0.0);
    EXPECT_NEAR(areas.both, both, 1e-12);
    EXPECT_NEAR(areas.only_a, 100 - both, 1e-12);
    EXPECT_NEAR(areas.only_b, 100 - both, 1e-12);
  }
}

TEST(MeasureRegions, OfASquareAndItselfTurned) {
  // The common part is a regular octagon around the circle of radius 1.
  const RegionAreas areas = measure_regions(
      polygon({7, 7}, std::numbers::sqrt2, 4, 0),
      polygon({7, 7}, std::numbers::sqrt2, 4, std::numbers::pi / 4));
  const double octagon = 8 * (std::numbers::sqrt2 - 1);
  EXPECT_NEAR(areas.both, octagon, 1e-13);
  EXPECT_NEAR(areas.only_a, 4 - octagon, 1e-13);
  EXPECT_NEAR(areas.only_b, 4 - octagon, 1e-13);
}

TEST(MeasureRegions, OfHolesAndNothing) {
  Contours pierced = rectangle({0, 0}, {10, 10});
  add_loop(pierced, {{2, 2}, {2, 4}, {5, 4}, {5, 2}});
  const RegionAreas areas =
      measure_regions(pierced, rectangle({0, 0}, {10, 10}));
  EXPECT_NEAR(areas.both, 94, 1e-12);
  EXPECT_NEAR(areas.only_a, 0, 1e-12);
  EXPECT_NEAR(areas.only_b, 6, 1e-12);
  EXPECT_NEAR(measure_regions(pierced, {}).only_a, 94, 1e-12);
  EXPECT_EQ(difference(measure_regions({}, {})), 0);
}

TEST(MeasureRegions, ContoursMayOverlapAndCross) {
  // Two squares as they come from a file that never united them.
  Contours overlapping = rectangle({0, 0}, {2, 2});
  add_loop(overlapping, {{1, 1}, {3, 1}, {3, 3}, {1, 3}});
  const RegionAreas areas =
      measure_regions(overlapping, rectangle({0, 0}, {3, 3}));
  EXPECT_NEAR(areas.both, 7, 1e-13);
  EXPECT_NEAR(areas.only_a, 0, 1e-13);
  EXPECT_NEAR(areas.only_b, 2, 1e-13);
  // A figure of eight: one half turns the other way, and counts.
  Contours eight;
  add_loop(eight, {{0, 0}, {2, 2}, {2, 0}, {0, 2}});
  EXPECT_NEAR(measure_regions(eight, {}).only_a, 2, 1e-13);
}

Contours random_star(std::mt19937& random) {
  std::uniform_real_distribution<double> share(0, 1);
  const int corners = 3 + static_cast<int>(random() % 40);
  std::vector<Vec2> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    const double radius = 1 + 4 * share(random);
    points.push_back(radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  Contours contours;
  add_loop(contours, points);
  return contours;
}

plane::Region region_of(const Contours& contours) {
  plane::Region region;
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    const auto loop = contours.loop(i);
    region.contours.emplace_back(loop.begin(), loop.end());
  }
  return region;
}

TEST(MeasureRegions, AgreesWithTheClipper) {
  std::mt19937 random(7);
  for (int run = 0; run < 300; ++run) {
    const Contours a = random_star(random);
    const Contours b = random_star(random);
    const std::array regions = {region_of(a), region_of(b)};
    const RegionAreas areas = measure_regions(a, b);
    EXPECT_NEAR(areas.both, plane::area(plane::intersect(regions)), 1e-5);
    EXPECT_NEAR(areas.only_a, plane::area(plane::subtract(regions)), 1e-5);
    EXPECT_NEAR(areas.a(), support::total_area(a), 1e-12);
    EXPECT_NEAR(areas.b(), support::total_area(b), 1e-12);
  }
}

TEST(MeasureRegions, TurningAllChangesNothing) {
  std::mt19937 random(8);
  const Contours a = random_star(random);
  const Contours b = random_star(random);
  const RegionAreas areas = measure_regions(a, b);
  for (double angle = 0.1; angle < 6; angle += 0.5) {
    const auto turned = [angle](Contours contours) {
      for (Vec2& p : contours.points) {
        p = {std::cos(angle) * p.x - std::sin(angle) * p.y,
             std::sin(angle) * p.x + std::cos(angle) * p.y};
      }
      return contours;
    };
    const RegionAreas after = measure_regions(turned(a), turned(b));
    EXPECT_NEAR(after.both, areas.both, 1e-12);
    EXPECT_NEAR(after.only_a, areas.only_a, 1e-12);
    EXPECT_NEAR(after.only_b, areas.only_b, 1e-12);
  }
}

TEST(MeasureRegions, OfManyLongBars) {
  // Minutes, if at each end all bars were looked at.
  constexpr int kBars = 40'000;
  Contours a;
  Contours b;
  for (int i = 0; i < kBars; ++i) {
    const Vec2 low(1e-3 * ((i * 7919) % kBars), 2.0 * i);
    const Vec2 high = low + Vec2(100, 1);
    add_loop(a, {low, {high.x, low.y}, high, {low.x, high.y}});
    const Vec2 up(0, 0.25);
    add_loop(b, {low + up, Vec2(high.x, low.y) + up, high + up,
                 Vec2(low.x, high.y) + up});
  }
  const RegionAreas areas = measure_regions(a, b);
  EXPECT_NEAR(areas.both, 75.0 * kBars, 1e-5);
  EXPECT_NEAR(areas.only_a, 25.0 * kBars, 1e-5);
  EXPECT_NEAR(areas.only_b, 25.0 * kBars, 1e-5);
}

TEST(MeasureRegions, OfShapesBetweenManyOthers) {
  // Where other edges cut the layer into bands, areas stay what they are.
  std::mt19937 random(10);
  Contours teeth;
  for (int i = 0; i < 500; ++i) {
    const Vec2 low(6, -10 + 0.04 * i);
    add_loop(teeth, {low, low + Vec2(1, 0), low + Vec2(1, 0.02)});
  }
  const double area = 500 * 0.01;
  for (int run = 0; run < 20; ++run) {
    Contours a = random_star(random);
    Contours b = random_star(random);
    const RegionAreas alone = measure_regions(a, b);
    for (Contours* contours : {&a, &b}) {
      for (std::size_t i = 0; i < teeth.loop_count(); ++i) {
        contours->add_loop(teeth.loop(i));
      }
    }
    const RegionAreas among = measure_regions(a, b);
    EXPECT_NEAR(among.both, alone.both + area, 1e-11);
    EXPECT_NEAR(among.only_a, alone.only_a, 1e-12);
    EXPECT_NEAR(among.only_b, alone.only_b, 1e-12);
  }
}

TEST(MeasureRegions, OfTheLeastAndTheGreatestNumbersEnds) {
  for (const double size : {5e-324, 1e-200, 1e200, 1e308}) {
    Contours contours;
    for (int i = 0; i < 40; ++i) {
      add_loop(contours, {{-size, -size}, {size, -size}, {0, size}});
    }
    measure_regions(contours, {});
  }
}

TEST(MeasureRegions, OfItselfIsNothingToTheLastDigit) {
  std::mt19937 random(9);
  for (int run = 0; run < 50; ++run) {
    const Contours star = random_star(random);
    EXPECT_EQ(difference(measure_regions(star, star)), 0);
  }
}

}  // namespace
}  // namespace lamina::plane
