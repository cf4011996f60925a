// Laws of leaving out vertices: nothing moves by more than the tolerance, and
// nothing joins, splits, crosses or vanishes.

#include "slicer/contour/simplify.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/slicer/contour/simplify_laws.h"
#include "tests/support/contour_checks.h"

namespace lamina::slicer {
namespace {

using plane::Contours;
using support::add_loop;
using support::distance_to_edges;

// counter-clockwise; clockwise for a hole
std::vector<Vec2> circle(Vec2 center, double radius, int count,
                         bool is_hole = false, double phase = 0) {
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    const double angle =
        phase + (is_hole ? -2 : 2) * std::numbers::pi * i / count;
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
  const double fewest = std::numbers::pi / std::acos(1 - tolerance / 10);
  EXPECT_LT(static_cast<double>(after.points.size()), 1.1 * fewest);
  expect_lawful(contours, tolerance, "circle");
}

// Fewest vertices of an inscribed polygon whose sides are nowhere farther than
// the tolerance from the circle: a side of angle α is r (1 - cos α/2) from its
// arc.
double fewest_of_circle(double radius, double tolerance) {
  return std::max(
      3.0, std::ceil(std::numbers::pi / std::acos(1 - tolerance / radius)));
}

TEST(Simplify, CirclesKeepHardlyMoreVerticesThanTheFewest) {
  for (const double radius : {0.5, 3.0, 40.0}) {
    for (const double tolerance : {1e-4, 1e-3, 1e-2, 0.05, 0.2}) {
      Contours contours;
      add_loop(contours, circle({3, 4}, radius, 20'000, false, 0.1));
      const Contours after = simplified(contours, tolerance);
      // One more where the last side meets the first vertex.
      EXPECT_LE(static_cast<double>(after.points.size()),
                1 + 1.02 * fewest_of_circle(radius, tolerance))
          << radius << " " << tolerance;
    }
  }
}

// Whether one side can stand for the run between the two vertices of the loop
// (indices modulo its size), by the definition alone.
bool can_skip(const std::vector<Vec2>& loop, std::size_t first,
              std::size_t last, double tolerance) {
  const Vec2 a = loop[first % loop.size()];
  const Vec2 way = loop[last % loop.size()] - a;
  const double length = std::hypot(way.x, way.y);
  if (length == 0) return false;
  for (std::size_t i = first + 1; i < last; ++i) {
    const Vec2 to = loop[i % loop.size()] - a;
    const double abscissa = (to.x * way.x + to.y * way.y) / length;
    const double deviation = (way.x * to.y - way.y * to.x) / length;
    if (std::abs(deviation) > tolerance || abscissa < 0 || abscissa > length) {
      return false;
    }
  }
  return true;
}

// Fewest vertices of the loop that stand for all of it, the first among them:
// the shortest path over all shortcuts.
std::size_t fewest_vertices(const std::vector<Vec2>& loop, double tolerance) {
  std::vector<std::size_t> count(loop.size() + 1, loop.size());
  count[0] = 0;
  for (std::size_t first = 0; first < loop.size(); ++first) {
    for (std::size_t last = first + 1; last <= loop.size(); ++last) {
      if (count[first] + 1 < count[last] &&
          can_skip(loop, first, last, tolerance)) {
        count[last] = count[first] + 1;
      }
    }
  }
  return std::max<std::size_t>(3, count.back());
}

TEST(Simplify, LoopsKeepAFewPercentMoreVerticesThanTheFewest) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  std::size_t kept = 0;
  std::size_t fewest = 0;
  for (int run = 0; run < 60; ++run) {
    // A few waves around a circle, as sections of shanks and prongs have.
    std::vector<Vec2> loop = circle({0, 0}, 1, 400, run % 2 == 1);
    const double waves = 2 + static_cast<double>(random() % 9);
    const double height = 0.3 * unit(random);
    const double noise = run % 3 == 0 ? 0.002 : 0;
    for (Vec2& p : loop) {
      p = p * (4 + height * std::sin(waves * std::atan2(p.y, p.x)) +
               noise * unit(random));
    }
    // Both begin at the same vertex.
    std::rotate(loop.begin(),
                std::min_element(loop.begin(), loop.end(),
                                 [](Vec2 a, Vec2 b) { return a.x < b.x; }),
                loop.end());
    Contours contours;
    add_loop(contours, loop);
    for (const double tolerance : {0.002, 0.01, 0.05}) {
      const std::size_t least = fewest_vertices(loop, tolerance);
      const std::size_t count = simplified(contours, tolerance).points.size();
      EXPECT_GE(count, least);
      EXPECT_LE(static_cast<double>(count),
                2 + 1.3 * static_cast<double>(least));
      kept += count;
      fewest += least;
    }
  }
  EXPECT_LE(static_cast<double>(kept), 1.04 * static_cast<double>(fewest));
}

TEST(Simplify, NoVertexStaysOnTheLineOfItsNeighbours) {
  // Sides divided as no tolerance would divide them, beside a thin wall.
  Contours contours;
  std::vector<Vec2> wall;
  for (int i = 0; i < 57; ++i) wall.emplace_back(i * 0.25, 0.0);
  for (int i = 0; i < 3; ++i) wall.emplace_back(57 * 0.25, i * 0.05);
  for (int i = 0; i < 91; ++i) wall.emplace_back(57 * 0.25 - i * 0.125, 0.15);
  wall.emplace_back(0, 0.15);
  add_loop(contours, wall);
  add_loop(contours, {{0, 0.16}, {1, 0.16}, {2, 0.16}, {2, 2}, {0, 2}});
  for (const double tolerance : {1e-6, 0.001, 0.07}) {
    EXPECT_EQ(simplified(contours, tolerance).points.size(), 8U) << tolerance;
    expect_lawful(contours, tolerance, "wall");
  }
  EXPECT_LE(simplified(contours, 0.2).points.size(), 8U);
  expect_lawful(contours, 0.2, "wall");
}

TEST(Simplify, ASecondTimeChangesNothingOnACircle) {
  for (const double tolerance : {1e-3, 1e-2, 0.1}) {
    Contours contours;
    add_loop(contours, circle({0, 0}, 7, 30'000));
    const Contours once = simplified(contours, tolerance);
    EXPECT_EQ(simplified(once, tolerance).points, once.points);
  }
}

TEST(Simplify, WallsThinnerThanTheToleranceAreThinnedOutTogether) {
  const double tolerance = 0.05;
  Contours ring;  // a wall a fifth of the tolerance thick
  add_loop(ring, circle({0, 0}, 5.01, 6'000));
  add_loop(ring, circle({0, 0}, 5, 6'000, true));
  expect_lawful(ring, tolerance, "wall");
  // Two polygons of n corners each stay apart where the sagitta of their sides
  // is the wall's thickness.
  EXPECT_LT(static_cast<double>(simplified(ring, tolerance).points.size()),
            1.5 * 2 * fewest_of_circle(5, 0.01));
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
  EXPECT_LE(after.points.size(), 5U);
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

TEST(Simplify, FilesOfDesignsFarFromTheOriginStaySound) {
  for (const double far : {100.0, 1000.0, 8000.0}) {
    const Vec2 center(far, -far);
    for (const double gap : {0.003, 0.01, 0.05}) {
      Contours ring;  // of waves that fit into each other
      for (const bool is_hole : {false, true}) {
        std::vector<Vec2> loop = circle({0, 0}, 1, 4'000, is_hole, 1e-4);
        for (Vec2& p : loop) {
          const double wave = std::sin(40 * std::atan2(p.y, p.x));
          p = center + p * (5 + 0.03 * wave - (is_hole ? gap : 0));
        }
        add_loop(ring, loop);
      }
      for (const double tolerance : {0.001, 0.01, 0.05, 0.2}) {
        expect_lawful(ring, tolerance,
                      std::to_string(far) + " " + std::to_string(gap));
      }
    }
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

// More than the tree of boxes tells apart.
TEST(Simplify, HundredsOfRingsInRingsKeepTheirPlaces) {
  Contours contours;
  for (int i = 0; i < 300; ++i) {
    add_loop(contours, circle({0, 0}, 1 - 0.0005 * i, 150, i % 2 == 1, i));
  }
  expect_lawful(contours, 0.002, "rings in rings");
}

// Out in a thousand rounds a micrometre apart, and back between them: what one
// round keeps makes the next keep it, too.
TEST(Simplify, ASpiralOfThousandsOfWallsStaysOpen) {
  constexpr int kPoints = 10000;
  std::vector<Vec2> spiral;
  const auto at = [](double i) {
    return (1 + i / 10000) * Vec2(std::cos(i * std::numbers::pi / 5),
                                  std::sin(i * std::numbers::pi / 5));
  };
  for (int i = 0; i < kPoints; ++i) spiral.push_back(at(i));
  for (int i = kPoints - 1; i >= 0; --i) spiral.push_back(at(i) * (1 - 1e-4));
  Contours contours;
  add_loop(contours, spiral);
  expect_lawful(contours, 0.001, "spiral");
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

TEST(Simplify, LoopsThatTouchInTwoPointsDoNotShareTheWayBetween) {
  // A square, and beside it an arc that starts and ends in its corners.
  Contours contours;
  add_loop(contours, {{0, 0}, {0.05, 0.5}, {0, 1}, {-1, 1}, {-1, 0}});
  add_loop(contours, {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.06, 0.5}});
  for (const double tolerance : {0.001, 0.055, 0.2}) {
    expect_lawful(contours, tolerance, std::to_string(tolerance));
  }
}

TEST(Simplify, AVertexThatAnotherSideForbidsStays) {
  // A hook whose tip reaches under the side that could do without its corner.
  Contours contours;
  add_loop(
      contours,
      {{0, 0}, {0.5, 0.00017}, {0.5, -1}, {1, -1}, {1, 0.00008}, {0, 0.00032}});
  expect_lawful(contours, 0.001, "hook");
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
