// Laws of leaving out vertices: nothing moves by more than the tolerance, and
// nothing joins, splits, crosses or vanishes.

#include "slicer/simplify.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/contour_checks.h"
#include "tests/support/edge_grid.h"

namespace lamina::slicer {
namespace {

using ldni::Contours;
using support::add_loop;
using support::are_sound;
using support::count_loops;
using support::distance_to_edges;

constexpr double kPi = std::numbers::pi;

// counter-clockwise; clockwise for a hole
std::vector<Vec2> circle(Vec2 center, double radius, int count,
                         bool is_hole = false, double phase = 0) {
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    const double angle = phase + (is_hole ? -2 : 2) * kPi * i / count;
    points.push_back(center + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return points;
}

// A wall along a wavy line: out along one side, back along the other.
std::vector<Vec2> wavy_wall(double thickness, int count, double phase) {
  std::vector<Vec2> points;
  const auto at = [&](double x, double side) {
    return Vec2(x, 0.3 * std::sin(3 * x + phase) + side);
  };
  for (int i = 0; i < count; ++i) {
    points.push_back(at(10.0 * i / (count - 1), 0));
  }
  for (int i = count - 1; i >= 0; --i) {
    // The two sides' vertices stand at different places.
    points.push_back(at(10.0 * (i + 0.37) / count, thickness));
  }
  return points;
}

Contours simplified(Contours contours, double tolerance) {
  Simplifier(tolerance).simplify(contours);
  return contours;
}

double distance_to_edge(Vec2 point, const support::Edge& edge) {
  const Vec2 along = edge.to - edge.from;
  const Vec2 to = point - edge.from;
  const double share = std::clamp((to.x * along.x + to.y * along.y) /
                                      (along.x * along.x + along.y * along.y),
                                  0.0, 1.0);
  const Vec2 away = to - share * along;
  return std::hypot(away.x, away.y);
}

// Greatest distance from one contour to the other, measured at vertices and at
// eight points of each edge; infinite where it is far above the tolerance.
double one_sided_distance(const Contours& from, const Contours& to,
                          double tolerance) {
  const std::vector<support::Edge> edges = support::edges_of(to);
  const support::EdgeGrid grid(edges, 2 * tolerance);
  const auto columns = grid.column_at(std::numeric_limits<double>::max()) + 1;
  double greatest = 0;
  for (std::size_t i = 0; i < from.loop_count(); ++i) {
    const auto loop = from.loop(i);
    for (std::size_t j = 0; j < loop.size(); ++j) {
      const Vec2 step = loop[(j + 1) % loop.size()] - loop[j];
      for (int k = 0; k < 8; ++k) {
        const Vec2 point = loop[j] + (k / 8.0) * step;
        double nearest = std::numeric_limits<double>::infinity();
        for (const std::uint32_t edge : grid.cell(
                 grid.row_at(point.y) * columns + grid.column_at(point.x))) {
          nearest = std::min(nearest, distance_to_edge(point, edges[edge]));
        }
        greatest = std::max(greatest, nearest);
      }
    }
  }
  return greatest;
}

// All laws at once.
void expect_lawful(const Contours& before, double tolerance,
                   const std::string& what) {
  const Contours after = simplified(before, tolerance);
  support::ContourRules rules;
  rules.collinear_distance = 0;  // random shapes may have such points before
  rules.least_area = 0;
  ASSERT_TRUE(are_sound(before, rules)) << what;
  EXPECT_TRUE(are_sound(after, rules)) << what;
  EXPECT_EQ(count_loops(before), count_loops(after)) << what;
  EXPECT_LE(one_sided_distance(after, before, tolerance), tolerance + 1e-12)
      << what;
  EXPECT_LE(one_sided_distance(before, after, tolerance), tolerance + 1e-12)
      << what;
  EXPECT_LE(after.points.size(), before.points.size()) << what;
}

TEST(Simplify, ToleranceZeroLeavesEverything) {
  Contours contours;
  add_loop(contours, circle({0, 0}, 1, 1000));
  EXPECT_EQ(simplified(contours, 0).points, contours.points);
}

TEST(Simplify, ACircleKeepsAboutAsManyVerticesAsTheToleranceNeeds) {
  Contours contours;
  add_loop(contours, circle({3, 4}, 10, 20'000));
  const double tolerance = 0.001;
  const Contours after = simplified(contours, tolerance);
  // A chord of angle α is r (1 - cos α/2) from its arc.
  const double fewest = kPi / std::acos(1 - tolerance / 10);
  EXPECT_LT(static_cast<double>(after.points.size()), 1.1 * fewest);
  expect_lawful(contours, tolerance, "circle");
}

TEST(Simplify, CornersStay) {
  Contours contours;
  std::vector<Vec2> square;
  for (int side = 0; side < 4; ++side) {
    for (int i = 0; i < 100; ++i) {
      const double s = i / 100.0;
      const double noise = i == 0 ? 0 : 1e-5 * ((i * 7919) % 13 - 6);
      const std::vector<Vec2> at = {
          {s, noise}, {1 - noise, s}, {1 - s, 1 - noise}, {noise, 1 - s}};
      square.push_back(at[static_cast<std::size_t>(side)]);
    }
  }
  add_loop(contours, square);
  const Contours after = simplified(contours, 0.001);
  for (const Vec2 corner : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}) {
    EXPECT_LT(distance_to_edges(after, corner), 1e-3);
  }
  EXPECT_LE(after.points.size(), 16U);
  expect_lawful(contours, 0.001, "square");
}

TEST(Simplify, WallsAndGapsThinnerThanTheToleranceStayOpen) {
  for (const double gap : {1e-2, 1e-3, 1e-4, 1e-5}) {
    Contours ring;  // a wall between two circles whose facets do not match
    add_loop(ring, circle({0, 0}, 5 + gap, 4'000));
    add_loop(ring, circle({0, 0}, 5, 4'000, true, 1e-4));
    expect_lawful(ring, 0.001, "ring wall " + std::to_string(gap));

    Contours gap_between;  // a gap between a disc and the ring around it
    add_loop(gap_between, circle({0, 0}, 6, 3000));
    add_loop(gap_between, circle({0, 0}, 5 + gap, 4'000, true));
    add_loop(gap_between, circle({0, 0}, 5, 4'000, false, 1e-4));
    expect_lawful(gap_between, 0.001, "ring gap " + std::to_string(gap));

    Contours wall;
    add_loop(wall, wavy_wall(gap, 3'000, 0.2));
    expect_lawful(wall, 0.001, "wavy wall " + std::to_string(gap));
  }
}

TEST(Simplify, LoopsSmallerThanTheToleranceStay) {
  Contours contours;
  add_loop(contours, circle({0, 0}, 5, 2000));
  for (int i = 0; i < 40; ++i) {
    const double angle = 0.1 + i;
    // Pin holes just inside the rim, where a shortcut would pass over them.
    add_loop(contours,
             circle((5 - 3e-5) * Vec2(std::cos(angle), std::sin(angle)), 4e-6,
                    16, true));
    add_loop(contours, circle((5 + 5e-4) * Vec2(std::cos(angle + 0.5),
                                                std::sin(angle + 0.5)),
                              1e-4, 32));
  }
  expect_lawful(contours, 0.001, "pin holes and grains");
}

TEST(Simplify, RandomStarsInsideOneAnotherKeepTheirPlaces) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int run = 0; run < 40; ++run) {
    // Star-shaped loops around one centre, each scaled into the one before:
    // disjoint by construction, and as near as 1e-4 to 1e-1.
    const int count = 50 + static_cast<int>(random() % 800);
    const double roughness = std::pow(10, -1 - 4 * unit(random));
    std::vector<double> radius(static_cast<std::size_t>(count));
    for (double& r : radius) r = 3 * (1 + roughness * (unit(random) - 0.5));
    Contours contours;
    double scale = 1;
    for (int loop = 0; loop < 6; ++loop) {
      std::vector<Vec2> points = circle({1, 2}, 1, count, loop % 2 == 1);
      for (int i = 0; i < count; ++i) {
        const auto at =
            static_cast<std::size_t>(loop % 2 == 1 ? (count - i) % count : i);
        auto& p = points[static_cast<std::size_t>(i)];
        p = Vec2(1, 2) + scale * radius[at] * (p - Vec2(1, 2));
      }
      add_loop(contours, points);
      scale *= 1 - std::pow(10, -1 - 3 * unit(random));
    }
    for (const double tolerance : {1e-4, 1e-3, 1e-2, 0.1}) {
      expect_lawful(contours, tolerance,
                    "run " + std::to_string(run) + " tolerance " +
                        std::to_string(tolerance));
    }
  }
}

TEST(Simplify, LoopsThatTouchInAPointStillTouchOrPart) {
  Contours contours;  // fine-sided squares, corner to corner
  for (const double shift : {0.0, 1.0}) {
    std::vector<Vec2> square;
    for (int i = 0; i < 10; ++i) square.emplace_back(shift + i / 10.0, shift);
    for (int i = 0; i < 10; ++i)
      square.emplace_back(shift + 1, shift + i / 10.0);
    for (int i = 0; i < 10; ++i)
      square.emplace_back(shift + 1 - i / 10.0, shift + 1);
    for (int i = 0; i < 10; ++i)
      square.emplace_back(shift, shift + 1 - i / 10.0);
    add_loop(contours, square);
  }
  const Contours after = simplified(contours, 0.01);
  EXPECT_EQ(after.points.size(), 8U);
  EXPECT_NEAR(support::total_area(after), 2, 1e-12);
}

TEST(Simplify, ThereAndBackAgainIsNotLost) {
  Contours contours;  // a needle 5e-4 wide with 1,000 vertices a side
  std::vector<Vec2> needle;
  for (int i = 0; i <= 1000; ++i) needle.emplace_back(i * 0.01, i % 2 * 1e-4);
  for (int i = 1000; i >= 0; --i)
    needle.emplace_back(i * 0.01, 5e-4 + i % 2 * 1e-4);
  add_loop(contours, needle);
  expect_lawful(contours, 0.01, "needle");
}

}  // namespace
}  // namespace lamina::slicer
