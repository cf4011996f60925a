// CGAL judges hull() of designs large and small: it makes convex hulls of
// points that are known otherwise, by the formula or as the corners of a Nef
// polyhedron. And of points as such, to the last bit.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "csg/boundary/convex_hull.h"
#include "csg/boundary/detail/orientation.h"
#include "csg/boundary/leaf_mesh.h"
#include "tests/oracle/exact_hull.h"
#include "tests/oracle/nef_solid.h"
#include "tests/oracle/whole_solid.h"
#include "tests/oracle/world_scene.h"
#include "tests/support/design.h"

namespace lamina::oracle {
namespace {

using support::Design;

// The corners of OpenSCAD's sphere: rings at the middles of equal angles.
void add_sphere(Vec3 centre, double r, int facets, std::vector<Vec3>& points) {
  using std::numbers::pi;
  const int rings = (facets + 1) / 2;
  for (int i = 0; i < rings; ++i) {
    const double polar = pi * (i + 0.5) / rings;
    for (int k = 0; k < facets; ++k) {
      const double turn = 2 * pi * k / facets;
      points.push_back(centre + r * Vec3(std::sin(polar) * std::cos(turn),
                                         std::sin(polar) * std::sin(turn),
                                         std::cos(polar)));
    }
  }
}

// Along a spiral over an egg, sizes mixed: many of them touch the hull.
TEST(Hulls, OfTenThousandSpheresAreThoseOfTheirCorners) {
  const Design design = Design::from_text(
      "hull() for (i = [0 : 99], k = [0 : 99]) {"
      "  n = 100 * i + k;"
      "  u = 1 - 2 * (n + 0.5) / 10000;"
      "  s = 40 * sqrt(1 - u * u);"
      "  a = 2.4 * n * 180 / PI;"
      "  translate([s * cos(a), s * sin(a), 50 * u])"
      "    sphere(1 + 0.01 * (n % 7), $fn = 8);"
      "}");
  std::vector<Vec3> points;
  for (int n = 0; n < 10000; ++n) {
    const double u = 1 - 2 * (n + 0.5) / 10000;
    const double s = 40 * std::sqrt(1 - u * u);
    const double a = 2.4 * n;
    add_sphere({s * std::cos(a), s * std::sin(a), 50 * u}, 1 + 0.01 * (n % 7),
               8, points);
  }
  const csg::Mesh hull = exact_hull(points);
  EXPECT_GT(hull.vertices.size(), 2000U);
  EXPECT_EQ(compare_with_solid(design.scene(), hull), "");
}

// Of what the children leave: its corners are those of a Nef polyhedron.
void expect_hull_of_corners(const std::string& children) {
  const Design solid = Design::from_text(children);
  const csg::Mesh corners = nef_boundary(world_scene(solid.scene()));
  const csg::Mesh hull = exact_hull(corners.vertices);
  EXPECT_GT(csg::signed_volume(hull), csg::signed_volume(corners) + 0.01);
  const std::string text = "hull() { " + children + " }";
  EXPECT_EQ(compare_with_solid(Design::from_text(text).scene(), hull), "")
      << text;
}

TEST(Hulls, OfADifferenceAreThoseOfItsCorners) {
  expect_hull_of_corners(
      "difference() { sphere(5, $fn = 14); translate([3, 1, 2]) sphere(4.5, "
      "$fn ="
      " 12); }");
  expect_hull_of_corners(
      "difference() { cube([6, 4, 3]); translate([4, 2, 1]) rotate([20, 30, "
      "40])"
      " cube(9); }");
  expect_hull_of_corners(
      "difference() { cylinder(h = 6, r = 3, $fn = 9); translate([1, 0, 3])"
      " rotate([0, 80, 10]) cylinder(h = 9, r = 2, $fn = 7, center = true); }"
      "translate([9, 2, 1]) intersection() { cube(3); rotate([0, 0, 40])"
      " translate([0, 0, 1]) sphere(3, $fn = 8); }");
}

TEST(Hulls, OfADifferenceThatLeavesPiecesAreThoseOfAllPieces) {
  expect_hull_of_corners(
      "difference() { rotate([10, 20, 30]) cube([9, 3, 2], center = true);"
      " cube([4, 9, 9], center = true); }");
}

// --- Points ------------------------------------------------------------------

class RandomPoints {
 public:
  explicit RandomPoints(unsigned seed) : random_(seed) {}

  double number(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  int whole(int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random_);
  }
  Vec3 direction() {
    const double x = number(-1, 1);
    const double y = number(-1, 1);
    return {x, y, number(-1, 1)};
  }

  // Turned, made smaller and moved away: coordinates round.
  std::vector<Vec3> place(std::vector<Vec3> points) {
    const Vec3 z = glm::normalize(direction());
    const Vec3 x = glm::normalize(glm::cross(z, direction()));
    const Vec3 y = glm::cross(z, x);
    const double size = std::pow(10, number(-3, 2));
    const Vec3 shift = std::pow(10, number(-3, 3)) * direction();
    for (Vec3& p : points) p = size * (p.x * x + p.y * y + p.z * z) + shift;
    return points;
  }

  // Each coordinate but 0 by a unit of the last place, or none.
  std::vector<Vec3> shake(std::vector<Vec3> points) {
    for (Vec3& point : points) {
      for (int axis = 0; axis < 3; ++axis) {
        const int steps = whole(-1, 1);
        if (steps != 0 && point[axis] != 0) {
          point[axis] = std::nextafter(point[axis], steps * HUGE_VAL);
        }
      }
    }
    return points;
  }

  // Many in a plane, on a line, on a circle, on a sphere.
  std::vector<Vec3> make(int kind) {
    const int count = whole(5, 200);
    const int size = whole(1, 6);
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) {
      const Vec3 free = direction();
      const Vec3 lattice(whole(0, size), whole(0, size), whole(0, size));
      const double turn = 2 * std::numbers::pi * whole(0, 40) / 40;
      const Vec3 ring(std::cos(turn), std::sin(turn), 0);
      switch (kind) {
        case 0:
          points.push_back(free);
          break;
        case 1:
          points.push_back(lattice);
          break;
        case 2:
          points.push_back(glm::normalize(free));
          break;
        case 3:
          points.push_back(ring + Vec3(3 * whole(0, 1), 0, size));
          break;
        case 4:
          points.emplace_back(free.x, free.y, whole(0, 1));
          break;
        case 5:
          points.push_back(free.x * (lattice + Vec3(1)));
          break;
        default:
          points.push_back(ring + (free.x + 2) * Vec3(whole(0, 1), 0, 1));
      }
    }
    points.emplace_back(0, 0, -1);
    points.emplace_back(0.5, 0.25, 0);
    points.emplace_back(0.25, 0.75, 0.5);
    return points;
  }

 private:
  std::mt19937_64 random_;
};

std::vector<Vec3> sorted(std::vector<Vec3> points) {
  std::sort(points.begin(), points.end(), [](const Vec3& a, const Vec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  });
  return points;
}

void expect_hull(const std::vector<Vec3>& points) {
  const csg::Mesh hull = csg::convex_hull(points);
  if (hull.triangles.empty()) return;
  EXPECT_EQ(hull.triangles.size() + 4, 2 * hull.vertices.size());
  for (const auto& [a, b, c] : hull.triangles) {
    for (const Vec3& point : points) {
      ASSERT_LE(exact_orientation(hull.vertices[a], hull.vertices[b],
                                  hull.vertices[c], point),
                0);
    }
  }
  EXPECT_EQ(sorted(hull.vertices), sorted(exact_hull(points).vertices));
}

TEST(PointHulls, HaveTheCornersOfCgals) {
  for (unsigned seed = 0; seed < 210; ++seed) {
    SCOPED_TRACE(seed);
    RandomPoints random(seed);
    const std::vector<Vec3> points = random.make(static_cast<int>(seed % 7));
    expect_hull(points);
    expect_hull(random.shake(points));
    expect_hull(random.place(points));
  }
}

TEST(PointHulls, RestOnSignsThatAreCgals) {
  for (unsigned seed = 0; seed < 700; ++seed) {
    RandomPoints random(seed);
    const std::vector<Vec3> points = random.make(static_cast<int>(seed % 7));
    for (const std::vector<Vec3>& p :
         {points, random.shake(points), random.place(points)}) {
      for (std::size_t i = 3; i < p.size(); ++i) {
        ASSERT_EQ(csg::orientation(p[i - 3], p[i - 2], p[i - 1], p[i]),
                  exact_orientation(p[i - 3], p[i - 2], p[i - 1], p[i]));
      }
    }
  }
}

}  // namespace
}  // namespace lamina::oracle
