// Balls that touch walls, against closed formulas and brute force.

#include "slicer/thickness/ball_finder.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/support/design.h"

namespace lamina::slicer {
namespace {

using support::Design;

constexpr double kBallPitch = 0.1;

TEST(BallFinder, FindsTheNearestPoint) {
  const Design design = Design::from_text("sphere(3, $fn = 24);");
  const SolidSamples samples = sample_solid(design.scene(), 0.3);
  const BallFinder balls(samples.points);
  for (int i = 0; i < 500; ++i) {
    const Vec3 place(4 * std::sin(i * 1.7), 4 * std::sin(i * 2.3 + 1),
                     4 * std::sin(i * 3.1 + 2));
    double least = 1e9;
    for (const SurfacePoint& point : samples.points) {
      least = std::min(least, glm::length(point.place - place));
    }
    const auto nearest = balls.nearest(place, 100);
    ASSERT_TRUE(nearest);
    EXPECT_NEAR(nearest->distance, least, 1e-12);
    EXPECT_FALSE(balls.nearest(place, least * 0.999));
  }
}

// A plate that lies flat, leans or stands: the ball between its sides is as
// wide as the plate is thick.
TEST(BallFinder, MeasuresAPlateHoweverItLies) {
  for (const char* turn : {"[0, 0, 0]", "[30, 0, 0]", "[90, 0, 0]",
                           "[20, 55, 10]", "[0, 45, 45]"}) {
    const Design design = Design::from_text(
        "rotate(" + std::string(turn) + ") cube([8, 8, 0.6], center = true);");
    const SolidSamples samples = sample_solid(design.scene(), kBallPitch);
    const BallFinder balls(samples.points);
    int measured = 0;
    for (const SurfacePoint& point : samples.points) {
      const Ball ball = balls.grow(point.place, -point.normal, 5);
      ASSERT_TRUE(ball.stop);
      // Not near the rim, nor on it.
      if (glm::length(point.place) > 3) continue;
      EXPECT_GE(2 * ball.radius, 0.6 - 1e-6);
      EXPECT_LE(2 * ball.radius, 0.6 + std::pow(kCover * kBallPitch, 2) / 0.6);
      const double angle = std::acos(
          std::clamp(glm::dot(point.place - ball.centre,
                              samples.points[*ball.stop].place - ball.centre) /
                         (ball.radius * ball.radius),
                     -1.0, 1.0));
      EXPECT_GT(angle, 5 * std::numbers::pi / 6);
      ++measured;
    }
    EXPECT_GT(measured, 3000);
  }
}

TEST(BallFinder, GrowsAsFarAsItMay) {
  const Design design = Design::from_text("cube(10, center = true);");
  const SolidSamples samples = sample_solid(design.scene(), 0.25);
  const BallFinder balls(samples.points);
  const Ball ball = balls.grow(Vec3(0, 0, 5), Vec3(0, 0, -1), 2);
  EXPECT_EQ(ball.radius, 2);
  EXPECT_FALSE(ball.stop);
  EXPECT_EQ(ball.centre, Vec3(0, 0, 3));
}

// In a cone of half angle a, the ball that touches the side at distance s from
// the tip is stopped by the other side, s · tan a from it.
TEST(BallFinder, MeasuresACone) {
  const Design design =
      Design::from_text("cylinder(r1 = 5, r2 = 0, h = 10, $fn = 400);");
  const SolidSamples samples = sample_solid(design.scene(), kBallPitch);
  const BallFinder balls(samples.points);
  const double half_angle = std::atan(0.5);
  for (const SurfacePoint& point : samples.points) {
    if (point.normal.z < 0.1 || point.place.z < 5 || point.place.z > 9) {
      continue;
    }
    const double from_tip = glm::length(point.place - Vec3(0, 0, 10));
    const double radius = from_tip * std::tan(half_angle);
    const Ball ball = balls.grow(point.place, -point.normal, 20);
    // Facets are flat: near their edges the neighbour stops the ball.
    EXPECT_LE(ball.radius, radius + 0.02);
  }
}

}  // namespace
}  // namespace lamina::slicer
