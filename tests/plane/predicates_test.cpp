#include "plane/predicates.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace lamina {
namespace {

// A point of a small lattice, exact in integers, moved far off: differences
// stay exact there.
struct LatticePoint {
  std::int64_t x;
  std::int64_t y;
  Vec2 at(Vec2 shift) const {
    return shift + Vec2(static_cast<double>(x), static_cast<double>(y));
  }
};

LatticePoint random_point(std::mt19937& random, std::int64_t size) {
  std::uniform_int_distribution<std::int64_t> any(-size, size);
  return {any(random), any(random)};
}

int exact_orientation(LatticePoint a, LatticePoint b, LatticePoint c) {
  const std::int64_t area =
      (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  return (area > 0) - (area < 0);
}

TEST(Orientation, AgreesWithIntegersOnSmallAndLargeLattices) {
  std::mt19937 random(1);
  for (const std::int64_t size : {2, 1000, 1'000'000'000}) {
    const Vec2 shift = size < 1'000'000 ? Vec2(0x1p40, -0x1p41) : Vec2(0);
    for (int i = 0; i < 20000; ++i) {
      const LatticePoint a = random_point(random, size);
      const LatticePoint b = random_point(random, size);
      const LatticePoint c = random_point(random, size);
      ASSERT_EQ(orientation(a.at(shift), b.at(shift), c.at(shift)),
                exact_orientation(a, b, c));
    }
  }
}

// The products differ by 1 in 2^106, which no double shows.
TEST(Orientation, SeesWhatTheProductsLose) {
  const double large = 0x1p53 - 1;
  const Vec2 a(0);
  const Vec2 b(large, large - 1);
  const Vec2 c(large - 1, large - 2);
  EXPECT_EQ(b.x * c.y, b.y * c.x);
  EXPECT_EQ(orientation(a, b, c), -1);
  EXPECT_EQ(orientation(a, c, b), 1);
  EXPECT_EQ(orientation(a, b, b), 0);
  EXPECT_EQ(orientation(a, b, 2.0 * b), 0);
}

TEST(CompareAngles, OrdersDirectionsAsTheirAngles) {
  const auto angle = [](Vec2 d) {
    const double a = std::atan2(d.y, d.x);
    return a < 0 ? a + 2 * std::numbers::pi : a;
  };
  for (int ax = -3; ax <= 3; ++ax) {
    for (int ay = -3; ay <= 3; ++ay) {
      for (int bx = -3; bx <= 3; ++bx) {
        for (int by = -3; by <= 3; ++by) {
          const Vec2 a(ax, ay);
          const Vec2 b(bx, by);
          if (a == Vec2(0) || b == Vec2(0)) continue;
          const double difference = angle(a) - angle(b);
          const int wanted = std::abs(difference) < 1e-9 ? 0
                             : difference < 0            ? -1
                                                         : 1;
          ASSERT_EQ(compare_angles(a, b), wanted)
              << ax << ' ' << ay << ' ' << bx << ' ' << by;
        }
      }
    }
  }
}

TEST(Precedes, OrdersByXAndThenByY) {
  EXPECT_TRUE(precedes({0, 5}, {1, 0}));
  EXPECT_TRUE(precedes({1, 0}, {1, 2}));
  EXPECT_FALSE(precedes({1, 2}, {1, 2}));
  EXPECT_FALSE(precedes({1, 2}, {1, 0}));
}

// The angles under which the point sees the edges, added up.
int winding_by_angles(const std::vector<Vec2>& loop, Vec2 point) {
  double sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 a = loop[i] - point;
    const Vec2 b = loop[(i + 1) % loop.size()] - point;
    sum += std::atan2(cross(a, b), dot(a, b));
  }
  return static_cast<int>(std::lround(sum / (2 * std::numbers::pi)));
}

bool lies_on(const std::vector<Vec2>& loop, Vec2 point) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    if (distance_to_segment(point, loop[i], loop[(i + 1) % loop.size()]) <
        1e-9) {
      return true;
    }
  }
  return false;
}

// Lattice points: rays pass through vertices and along edges all the time.
TEST(WindingNumber, AgreesWithTheSumOfAnglesForAnyLoop) {
  std::mt19937 random(2);
  for (int i = 0; i < 2000; ++i) {
    std::vector<Vec2> loop;
    for (std::size_t k = 0; k < 3 + random() % 8; ++k) {
      loop.push_back(random_point(random, 3).at(Vec2(0)));
    }
    std::vector<Vec2> closed = loop;
    closed.push_back(loop.front());
    for (int x = -4; x <= 4; ++x) {
      for (int y = -4; y <= 4; ++y) {
        const Vec2 point(x, y);
        if (lies_on(loop, point)) continue;
        ASSERT_EQ(winding_number(loop, point), winding_by_angles(loop, point));
        ASSERT_EQ(winding_number(closed, point), winding_number(loop, point));
      }
    }
  }
}

TEST(WindingNumber, IsNoneOfDegenerateLoops) {
  EXPECT_EQ(winding_number({}, Vec2(0)), 0);
  EXPECT_EQ(winding_number(std::vector<Vec2>{{1, 1}}, Vec2(0)), 0);
  EXPECT_EQ(winding_number(std::vector<Vec2>{{1, -1}, {1, 1}}, Vec2(0)), 0);
}

TEST(Crossing, IsNegatedByReversal) {
  std::mt19937 random(3);
  for (int i = 0; i < 5000; ++i) {
    const Vec2 a = random_point(random, 3).at(Vec2(0));
    const Vec2 b = random_point(random, 3).at(Vec2(0));
    const Vec2 point = random_point(random, 3).at(Vec2(0));
    ASSERT_EQ(crossing(a, b, point), -crossing(b, a, point));
  }
}

TEST(DistanceToSegment, IsThatOfTheNearestOfManyPoints) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto point = [&] { return Vec2(any(random), any(random)); };
  for (int i = 0; i < 200; ++i) {
    const Vec2 p = point();
    const Vec2 a = point();
    const Vec2 b = point();
    double least = 1e300;
    constexpr int kSteps = 4000;
    for (int k = 0; k <= kSteps; ++k) {
      const Vec2 away = p - (a + double(k) / kSteps * (b - a));
      least = std::min(least, std::sqrt(dot(away, away)));
    }
    ASSERT_NEAR(distance_to_segment(p, a, b), least, 1e-3);
    ASSERT_LE(distance_to_segment(p, a, b), least + 1e-15);
  }
}

TEST(DistanceToSegment, ReachesTheEndsAndTakesASegmentOfNoLength) {
  EXPECT_EQ(distance_to_segment({-3, 4}, {0, 0}, {10, 0}), 5);
  EXPECT_EQ(distance_to_segment({13, -4}, {0, 0}, {10, 0}), 5);
  EXPECT_EQ(distance_to_segment({4, -2}, {0, 0}, {10, 0}), 2);
  EXPECT_EQ(distance_to_segment({3, 4}, {0, 0}, {0, 0}), 5);
  EXPECT_EQ(nearest_share({3, 4}, {0, 0}, {0, 0}), 0);
  EXPECT_EQ(nearest_share({2.5, 4}, {0, 0}, {10, 0}), 0.25);
}

}  // namespace
}  // namespace lamina
