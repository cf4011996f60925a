// Convex hulls, against laws that integers decide.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "csg/boundary/convex_hull.h"
#include "csg/boundary/detail/orientation.h"
#include "csg/boundary/leaf_mesh.h"
#include "tests/csg/lower/mesh_checks.h"

namespace lamina::csg {
namespace {

using Lattice = std::array<std::int64_t, 3>;

Vec3 point_of(const Lattice& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]),
          static_cast<double>(p[2])};
}

Lattice lattice_of(const Vec3& p) {
  return {std::llround(p.x), std::llround(p.y), std::llround(p.z)};
}

Lattice minus(const Lattice& a, const Lattice& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

// For coordinates up to 2^18.
int integer_orientation(const Lattice& a, const Lattice& b, const Lattice& c,
                        const Lattice& d) {
  const Lattice u = minus(b, a);
  const Lattice v = minus(c, a);
  const Lattice w = minus(d, a);
  const std::int64_t volume = w[0] * (u[1] * v[2] - u[2] * v[1]) +
                              w[1] * (u[2] * v[0] - u[0] * v[2]) +
                              w[2] * (u[0] * v[1] - u[1] * v[0]);
  return (volume > 0) - (volume < 0);
}

std::vector<Lattice> random_lattice(std::mt19937& random, std::size_t count,
                                    std::int64_t size) {
  std::uniform_int_distribution<std::int64_t> any(-size, size);
  std::vector<Lattice> points(count);
  for (Lattice& point : points) {
    for (std::int64_t& x : point) x = any(random);
  }
  return points;
}

TEST(SpaceOrientation, AgreesWithIntegersOnSmallAndLargeLattices) {
  std::mt19937 random(1);
  for (const std::int64_t size : {1, 20, 1000, 1 << 18}) {
    // Moved and thinned out; differences stay exact where they are small.
    const Vec3 shift(size < 2000 ? 0x1p40 : 0, size < 2000 ? -0x1p41 : 0, 0);
    for (int i = 0; i < 20000; ++i) {
      const std::vector<Lattice> p = random_lattice(random, 4, size);
      const auto at = [&](std::size_t k) { return point_of(p[k]) + shift; };
      ASSERT_EQ(orientation(at(0), at(1), at(2), at(3)),
                integer_orientation(p[0], p[1], p[2], p[3]));
    }
  }
}

// d is off the plane x + y = z by the last bit of numbers that are far larger,
// or far smaller, than the others.
TEST(SpaceOrientation, SeesTheLastBit) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int i = 0; i < 20000; ++i) {
    const auto in_plane = [&](int scale) {
      // 26 bits each: their sum is exact.
      const double x = std::ldexp(std::round(number(random) * 0x1p25), scale);
      const double y = std::ldexp(std::round(number(random) * 0x1p25), scale);
      return Vec3(x, y, x + y);
    };
    const Vec3 a = in_plane(0);
    const Vec3 b = in_plane(i % 40 - 20);
    const Vec3 c = in_plane(20 - i % 30);
    const double turn = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (std::abs(turn) < 1) continue;
    const Vec3 d = in_plane(i % 60 - 30);
    ASSERT_EQ(orientation(a, b, c, d), 0);
    const Vec3 above(d.x, d.y, std::nextafter(d.z, HUGE_VAL));
    ASSERT_EQ(orientation(a, b, c, above), turn > 0 ? 1 : -1);
    ASSERT_EQ(orientation(above, a, b, c), turn > 0 ? -1 : 1);
    const Vec3 left(std::nextafter(d.x, -HUGE_VAL), d.y, d.z);
    ASSERT_EQ(orientation(b, c, a, left), turn > 0 ? 1 : -1);
  }
}

// --- Hulls -------------------------------------------------------------------

std::vector<Vec3> points_of(const std::vector<Lattice>& lattice) {
  std::vector<Vec3> points;
  for (const Lattice& point : lattice) points.push_back(point_of(point));
  return points;
}

std::set<Lattice> corners_of(const Mesh& mesh) {
  std::set<Lattice> corners;
  for (const Vec3& vertex : mesh.vertices) corners.insert(lattice_of(vertex));
  return corners;
}

// How many triangles of the hull the point is above.
long count_below(const Mesh& hull, const Lattice& point) {
  return std::count_if(
      hull.triangles.begin(), hull.triangles.end(), [&](const auto& triangle) {
        const auto& [a, b, c] = triangle;
        return integer_orientation(lattice_of(hull.vertices[a]),
                                   lattice_of(hull.vertices[b]),
                                   lattice_of(hull.vertices[c]), point) > 0;
      });
}

void expect_hull(const std::vector<Lattice>& points) {
  const Mesh hull = convex_hull(points_of(points));
  if (hull.triangles.empty()) {
    for (std::size_t i = 3; i < points.size(); ++i) {
      ASSERT_EQ(integer_orientation(points[0], points[1], points[2], points[i]),
                0);
    }
    return;
  }
  EXPECT_TRUE(is_closed(hull));
  EXPECT_EQ(hull.triangles.size() + 4, 2 * hull.vertices.size());
  const std::set<Lattice> given(points.begin(), points.end());
  const std::set<Lattice> corners = corners_of(hull);
  EXPECT_EQ(corners.size(), hull.vertices.size());
  EXPECT_TRUE(std::includes(given.begin(), given.end(), corners.begin(),
                            corners.end()));
  for (const Lattice& point : given) ASSERT_EQ(count_below(hull, point), 0);

  // Without a corner the hull is smaller.
  for (const Lattice& corner : corners) {
    std::vector<Lattice> others(given.begin(), given.end());
    std::erase(others, corner);
    const Mesh rest = convex_hull(points_of(others));
    ASSERT_TRUE(rest.triangles.empty() || count_below(rest, corner) > 0);
  }

  // Turned and mirrored.
  for (int way = 1; way < 48; ++way) {
    std::array<std::size_t, 3> axes = {0, 1, 2};
    for (int i = 0; i < way / 8; ++i) std::ranges::next_permutation(axes);
    const auto moved = [&](const Lattice& p) {
      Lattice q{};
      for (std::size_t i = 0; i < 3; ++i) {
        q[i] = (way >> i & 1) != 0 ? -p[axes[i]] : p[axes[i]];
      }
      return q;
    };
    std::vector<Lattice> others;
    for (const Lattice& point : points) others.push_back(moved(point));
    std::set<Lattice> wanted;
    for (const Lattice& corner : corners) wanted.insert(moved(corner));
    ASSERT_EQ(corners_of(convex_hull(points_of(others))), wanted);
  }
}

TEST(Quickhull, OfLatticePointsHoldsThemAll) {
  std::mt19937 random(3);
  for (const std::int64_t size : {1, 2, 3, 5, 30, 1 << 18}) {
    for (int trial = 0; trial < 60; ++trial) {
      SCOPED_TRACE(testing::Message() << size << ' ' << trial);
      const std::size_t count = 4 + static_cast<std::size_t>(trial);
      expect_hull(random_lattice(random, count, size));
    }
  }
}

// All of them lie in few planes, on few lines.
TEST(Quickhull, OfPointsInFewPlanesHoldsThemAll) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE(trial);
    // Multiples of a few points, sums of a few edges.
    const std::vector<Lattice> base = random_lattice(random, 4, 9);
    std::vector<Lattice> points = {{0, 0, 0}};
    std::uniform_int_distribution<std::int64_t> factor(0, 3);
    for (int i = 0; i < 60; ++i) {
      Lattice sum = {0, 0, 0};
      for (const Lattice& edge : base) {
        const std::int64_t times =
            trial % 2 == 0 && i % 4 != 0 && &edge != &base[i % 4]
                ? 0
                : factor(random);
        for (std::size_t k = 0; k < 3; ++k) sum[k] += times * edge[k];
      }
      points.push_back(sum);
    }
    expect_hull(points);
  }
}

// 23² + 14² + 10² = 825 has many more.
TEST(Quickhull, OfPointsOnASphereHasThemAllAsCorners) {
  for (const std::int64_t square : {9, 50, 825}) {
    std::vector<Lattice> points;
    for (std::int64_t x = -30; x <= 30; ++x) {
      for (std::int64_t y = -30; y <= 30; ++y) {
        for (std::int64_t z = -30; z <= 30; ++z) {
          if (x * x + y * y + z * z == square) points.push_back({x, y, z});
        }
      }
    }
    EXPECT_EQ(convex_hull(points_of(points)).vertices.size(), points.size());
    if (points.size() < 100) expect_hull(points);
  }
}

// Products of three of them underflow, some to nothing and some in part.
TEST(Quickhull, CountsTheLeastCoordinatesAsZero) {
  std::mt19937_64 random(5);
  for (int lowest = -1074; lowest < -240; ++lowest) {
    SCOPED_TRACE(lowest);
    std::uniform_real_distribution<double> power(lowest, lowest + 4);
    const auto least = [&] { return -std::exp2(power(random)); };
    std::vector<Vec3> points;
    for (int i = 1; i < 8; ++i) points.emplace_back(i & 1, i >> 1 & 1, i >> 2);
    for (int i = 0; i < 30; ++i) {
      const double x = least();
      const double y = least();
      points.emplace_back(x, y, least());
    }
    const Mesh mesh = convex_hull(points);
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_DOUBLE_EQ(signed_volume(mesh), 1);
  }
}

// --- Costs: sizes that took minutes where each facet was asked ---------------

void add_disc(Vec3 centre, double r, int count, std::vector<Vec3>& points) {
  for (int i = 0; i < count; ++i) {
    const double turn = 2 * std::numbers::pi * i / count;
    points.push_back(centre + r * Vec3(std::cos(turn), std::sin(turn), 0));
  }
}

TEST(Quickhull, OfFineDiscsCostsLittleMoreThanTheirPoints) {
  constexpr int kCount = 50'000;
  std::vector<Vec3> points;
  for (const double z : {0, 1}) {
    add_disc({0, 0, z}, 10, kCount, points);
    add_disc({30, 0, z}, 5, kCount, points);
  }
  // Half a turn of each disc, and the ends of the sides between.
  const std::size_t corners = convex_hull(points).vertices.size();
  EXPECT_NEAR(static_cast<double>(corners), 2.0 * kCount, 8);
}

// One point after the other becomes the tip of a fan of tens of thousands of
// facets while all points before it on the arc wait for theirs.
TEST(Quickhull, OfACrowdedArcAboveADiscCostsLittleMoreThanItsPoints) {
  constexpr int kCount = 80'000;
  std::vector<Vec3> points;
  add_disc({0, 0, 0}, 10, kCount, points);
  for (int i = 0; i < kCount; ++i) {
    const double t = std::pow(0.99, i);
    points.emplace_back(0.01 * t, 0, 20 + 0.01 * std::sqrt(1 - t * t));
  }
  EXPECT_GT(convex_hull(points).vertices.size(), 80'000U);
}

}  // namespace
}  // namespace lamina::csg
