// The winding number of a sum of surfaces against the definition: p lies in the
// sum where the one surface meets p less the other.

#include "csg/minkowski/surface_sum.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "csg/boundary/leaf_mesh.h"
#include "csg/mesh/edge_table.h"
#include "tests/support/mesh_winding.h"

namespace lamina::csg {
namespace {

using std::numbers::pi;

// A torus around an axis, which has rings and saddles: translates meet in
// several curves, some of them closed on one side of either.
Mesh torus(double radius, double thickness, std::uint32_t around,
           std::uint32_t across) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t k = 0; k < across; ++k) {
      const double u = 2 * pi * i / around;
      const double v = 2 * pi * k / across;
      const double r = radius + thickness * std::cos(v);
      mesh.vertices.emplace_back(r * std::cos(u), r * std::sin(u),
                                 thickness * std::sin(v));
      const std::uint32_t a = i * across + k;
      const std::uint32_t b = i * across + (k + 1) % across;
      const std::uint32_t c = (i + 1) % around * across + k;
      const std::uint32_t d = (i + 1) % around * across + (k + 1) % across;
      mesh.triangles.push_back({a, c, d});
      mesh.triangles.push_back({a, d, b});
    }
  }
  return mesh;
}

// Every vertex at a random distance along its direction, all turned about.
Mesh shake(Mesh mesh, std::mt19937& random) {
  std::uniform_real_distribution<double> share(0.7, 1.3);
  std::normal_distribution<double> any;
  const Vec3 x = glm::normalize(Vec3(any(random), any(random), any(random)));
  const Vec3 y = glm::normalize(
      glm::cross(x, Vec3(any(random), any(random), any(random))));
  for (Vec3& v : mesh.vertices) {
    v = share(random) * v;
    v = v.x * x + v.y * y + v.z * glm::cross(x, y);
  }
  return mesh;
}

JoinedFaces faces_of(const Mesh& mesh) {
  std::vector<std::vector<std::uint32_t>> loops;
  std::vector<Vec3> normals;
  for (const auto& t : mesh.triangles) {
    loops.push_back({t[0], t[1], t[2]});
    const Vec3 area = glm::cross(mesh.vertices[t[1]] - mesh.vertices[t[0]],
                                 mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    normals.push_back(glm::normalize(area));
  }
  return {mesh.vertices, std::move(loops), normals};
}

bool crosses(const Vec3& from, const Vec3& to, std::span<const Vec3> t) {
  const auto side = [](const Vec3& a, const Vec3& b, const Vec3& c,
                       const Vec3& d) {
    return glm::dot(glm::cross(b - a, c - a), d - a) > 0;
  };
  if (side(t[0], t[1], t[2], from) == side(t[0], t[1], t[2], to)) return false;
  const bool first = side(from, to, t[0], t[1]);
  return first == side(from, to, t[1], t[2]) &&
         first == side(from, to, t[2], t[0]);
}

bool do_meet(std::span<const Vec3> a, std::span<const Vec3> b) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t k = (i + 1) % 3;
    if (crosses(a[i], a[k], b) || crosses(b[i], b[k], a)) return true;
  }
  return false;
}

// Whether p = x + y for some point x of one surface and y of the other.
bool is_sum(const Mesh& a, const Mesh& b, const Vec3& p) {
  return std::any_of(
      a.triangles.begin(), a.triangles.end(), [&](const auto& t) {
        const Vec3 first[] = {a.vertices[t[0]], a.vertices[t[1]],
                              a.vertices[t[2]]};
        return std::any_of(
            b.triangles.begin(), b.triangles.end(), [&](const auto& u) {
              const Vec3 second[] = {p - b.vertices[u[0]], p - b.vertices[u[1]],
                                     p - b.vertices[u[2]]};
              return do_meet(first, second);
            });
      });
}

struct Tally {
  int inside = 0;
  int outside = 0;
};

// Compares at random points.
Tally expect_definition(const Mesh& a, const Mesh& b, int points,
                        std::mt19937& random) {
  const Vec3 shift(3, -2, 5);
  const Mesh sum = add_surfaces(faces_of(a), faces_of(b), shift);
  EXPECT_FALSE(EdgeTable::of(sum).is_open());
  double size = 0;
  for (const Vec3& v : sum.vertices) {
    size = std::max(size, glm::length(v - shift));
  }
  std::uniform_real_distribution<double> place(-size, size);
  Tally tally;
  for (int i = 0; i < points; ++i) {
    const Vec3 p(place(random), place(random), place(random));
    const double winding = support::winding_number(sum, p + shift);
    EXPECT_NEAR(winding, std::round(winding), 1e-6);
    const bool is_inside = is_sum(a, b, p);
    EXPECT_EQ(is_inside, std::round(winding) > 0) << winding;
    EXPECT_GE(std::round(winding), 0);
    ++(is_inside ? tally.inside : tally.outside);
  }
  return tally;
}

TEST(SurfaceSum, WindsAroundWhatTheDefinitionSays) {
  std::mt19937 random(20);
  for (int i = 0; i < 6; ++i) {
    const Mesh a = shake(torus(3, 1, 8, 5), random);
    const Mesh b = shake(torus(2, 0.5, 5, 4), random);
    const Tally tally = expect_definition(a, b, 300, random);
    EXPECT_GT(tally.inside, 30);
    EXPECT_GT(tally.outside, 30);
  }
}

// Level faces, upright ones and equal normals: a cube and its like.
TEST(SurfaceSum, OfFacesThatAreParallel) {
  std::mt19937 random(21);
  const Mesh cube = [] {
    Loft loft;
    loft.outline = std::make_shared<const std::vector<Vec2>>(
        std::vector<Vec2>{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
    loft.profile = {{1, -1}, {1, 1}};
    Leaf leaf;
    leaf.lofts.push_back(loft);
    return explicit_mesh(leaf);
  }();
  Mesh small = cube;
  for (Vec3& v : small.vertices) v *= 0.25;
  const Tally tally = expect_definition(cube, small, 2000, random);
  EXPECT_GT(tally.outside, 100);  // the cavity
}

// Seams: a surface in pieces that share no vertex has the same sum.
TEST(SurfaceSum, OfFacesThatAreNotJoined) {
  std::mt19937 random(22);
  const Mesh a = shake(torus(3, 1, 6, 4), random);
  Mesh soup;
  const Mesh b = shake(torus(2, 0.5, 4, 3), random);
  for (std::size_t i = 0; i < b.triangles.size(); ++i) {
    const Vec3 apart(1e-5 * static_cast<double>(i % 7), 0, 0);
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t corner : b.triangles[i]) {
      soup.vertices.push_back(b.vertices[corner] + apart);
    }
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  const Tally tally = expect_definition(a, soup, 600, random);
  EXPECT_GT(tally.inside, 30);
}

TEST(SurfaceSum, OfSmoothBodiesGrowsAlmostWithTheirFaces) {
  const auto facets = [](std::uint32_t n) {
    const Mesh sum = add_surfaces(faces_of(torus(3, 1, 2 * n, n)),
                                  faces_of(torus(2, 0.7, 2 * n, n)), Vec3(0));
    return static_cast<double>(sum.triangles.size());
  };
  // Four times as many faces of each: √4 times more than as many facets.
  EXPECT_LT(facets(24) / facets(12), 9);
}

}  // namespace
}  // namespace lamina::csg
