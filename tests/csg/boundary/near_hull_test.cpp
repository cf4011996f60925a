#include "csg/boundary/near_hull.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "csg/boundary/leaf_mesh.h"
#include "csg/facets.h"
#include "plane/region/region.h"
#include "plane/region/triangulate.h"
#include "tests/csg/lower/mesh_checks.h"

namespace lamina::csg {
namespace {

// A cube of side 10 whose upper side is a ridge or a valley: one of its
// diagonals, from corner 4 to 6, is bent down or up.
Mesh cube(double rise, bool is_valley) {
  Mesh mesh;
  for (const double z : {0.0, 10.0}) {
    for (const Vec2 p : {Vec2(0, 0), Vec2(10, 0), Vec2(10, 10), Vec2(0, 10)}) {
      const bool is_raised = z > 0 && p.x != p.y;
      mesh.vertices.emplace_back(p, z + (is_raised ? rise : 0));
    }
  }
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 5}, {0, 5, 4}, {1, 2, 6},
                    {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  if (is_valley) {
    mesh.triangles.push_back({4, 5, 6});
    mesh.triangles.push_back({4, 6, 7});
  } else {
    mesh.triangles.push_back({4, 5, 7});
    mesh.triangles.push_back({5, 6, 7});
  }
  return mesh;
}

TEST(NearHull, OfWhatIsConvexIsItself) {
  const auto hull = near_hull(cube(1, false), 0);
  ASSERT_TRUE(hull);
  EXPECT_TRUE(is_closed(*hull));
  EXPECT_NEAR(signed_volume(*hull), 1000 + 100 * 2.0 / 3, 1e-9);
}

TEST(NearHull, StandsForAMeshUpToADepth) {
  // The valley's bottom lies 1 below the ridge.
  EXPECT_FALSE(near_hull(cube(1, true), 0.9));
  const auto hull = near_hull(cube(1, true), 1);
  ASSERT_TRUE(hull);
  EXPECT_NEAR(signed_volume(*hull), 1000 + 100 * 2.0 / 3, 1e-9);
}

TEST(NearHull, IsNoneOfADent) {
  Mesh mesh = cube(0, false);
  mesh.triangles.resize(10);
  mesh.vertices.emplace_back(5, 5, 9);
  for (std::uint32_t i = 0; i < 4; ++i) {
    mesh.triangles.push_back({4 + i, 4 + (i + 1) % 4, 8});
  }
  EXPECT_FALSE(near_hull(mesh, 0.9));
  EXPECT_TRUE(near_hull(mesh, 1));
}

TEST(NearHull, IsNoneOfWhatHasNoVolume) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
  EXPECT_FALSE(near_hull(mesh, 1));
}

// --- Sheets ------------------------------------------------------------------

constexpr double kThickness = 0.1;

// A plate over the region whose walls lean inwards by so much.
Mesh sheet(const plane::Region& region, double bevel) {
  Mesh mesh;
  std::vector<Vec3> high;
  for (const plane::Contour& contour : region.contours) {
    const auto size = contour.size();
    for (std::size_t i = 0; i < size; ++i) {
      const Vec2 a =
          glm::normalize(contour[i] - contour[(i + size - 1) % size]);
      const Vec2 b = glm::normalize(contour[(i + 1) % size] - contour[i]);
      const Vec2 inwards = Vec2(-a.y - b.y, a.x + b.x) / (1 + glm::dot(a, b));
      mesh.vertices.emplace_back(contour[i], 0);
      high.emplace_back(contour[i] + bevel * inwards, kThickness);
    }
  }
  const auto count = static_cast<std::uint32_t>(high.size());
  mesh.vertices.insert(mesh.vertices.end(), high.begin(), high.end());
  for (const auto& [a, b, c] : plane::triangulate(region)) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({a + count, b + count, c + count});
  }
  std::uint32_t first = 0;
  for (const plane::Contour& contour : region.contours) {
    const auto size = static_cast<std::uint32_t>(contour.size());
    for (std::uint32_t i = 0; i < size; ++i) {
      const std::uint32_t a = first + i;
      const std::uint32_t b = first + (i + 1) % size;
      mesh.triangles.push_back({a, b, b + count});
      mesh.triangles.push_back({a, b + count, a + count});
    }
    first += size;
  }
  return mesh;
}

plane::Region star(int points, double inner, double outer) {
  plane::Contour contour;
  for (int i = 0; i < 2 * points; ++i) {
    const double angle = i * std::numbers::pi / points;
    contour.push_back((i % 2 == 0 ? outer : inner) *
                      Vec2(std::cos(angle), std::sin(angle)));
  }
  return {{contour}};
}

plane::Region polygon(plane::Contour contour) { return {{std::move(contour)}}; }

// All of a sheet lies near the planes of its hull's facets.
TEST(NearHull, IsNoneOfSheetsWithNotchesOrHoles) {
  const std::pair<const char*, plane::Region> kSheets[] = {
      {"ell",
       polygon({{0, 0}, {50, 0}, {50, 10}, {10, 10}, {10, 50}, {0, 50}})},
      {"plus", polygon({{20, 0},
                        {30, 0},
                        {30, 20},
                        {50, 20},
                        {50, 30},
                        {30, 30},
                        {30, 50},
                        {20, 50},
                        {20, 30},
                        {0, 30},
                        {0, 20},
                        {20, 20}})},
      {"u", polygon({{0, 0},
                     {50, 0},
                     {50, 50},
                     {40, 50},
                     {40, 10},
                     {10, 10},
                     {10, 50},
                     {0, 50}})},
      {"small notch", polygon({{0, 0},
                               {50, 0},
                               {50, 50},
                               {26, 50},
                               {26, 48},
                               {24, 48},
                               {24, 50},
                               {0, 50}})},
      {"star", star(5, 10, 30)},
      {"ring",
       {{{{0, 0}, {50, 0}, {50, 50}, {0, 50}},
         {{20, 20}, {20, 30}, {30, 30}, {30, 20}}}}}};
  for (const auto& [name, region] : kSheets) {
    for (const double bevel : {0.0, 0.1, 0.9}) {
      const Mesh mesh = sheet(region, bevel);
      ASSERT_TRUE(is_closed(mesh)) << name;
      ASSERT_GT(signed_volume(mesh), 0) << name;
      for (const double depth : {kThickness, 2 * kThickness, 0.9}) {
        EXPECT_FALSE(near_hull(mesh, depth)) << name << ' ' << bevel;
      }
    }
  }
}

TEST(NearHull, IsOneOfAConvexSheet) {
  for (const double bevel : {0.0, 0.9}) {
    for (const double depth : {0.0, 2 * kThickness}) {
      const Mesh mesh = sheet(csg::circle(20, 90), bevel);
      const auto hull = near_hull(mesh, depth);
      ASSERT_TRUE(hull);
      EXPECT_NEAR(signed_volume(*hull), signed_volume(mesh), 1e-9);
    }
  }
}

// A ball's quads are not plane once it is stretched by other factors at each
// ring, and each has one diagonal or the other.
TEST(NearHull, StandsForARoundMeshWithAnyDiagonals) {
  constexpr std::uint32_t kSides = 48;
  constexpr std::uint32_t kRings = 23;
  Mesh mesh;
  mesh.vertices = {{0, 0, -10}, {0, 0, 10}};
  const auto at = [](std::uint32_t ring, std::uint32_t side) {
    return 2 + ring * kSides + side % kSides;
  };
  for (std::uint32_t i = 0; i < kRings; ++i) {
    const double height = (i + 1) * std::numbers::pi / (kRings + 1);
    for (std::uint32_t j = 0; j < kSides; ++j) {
      const double angle = (2 * j + i) * std::numbers::pi / kSides;
      mesh.vertices.emplace_back(10 * std::sin(height) * std::cos(angle),
                                 10 * std::sin(height) * std::sin(angle),
                                 -10 * std::cos(height));
    }
  }
  for (std::uint32_t j = 0; j < kSides; ++j) {
    mesh.triangles.push_back({0, at(0, j + 1), at(0, j)});
    mesh.triangles.push_back({1, at(kRings - 1, j), at(kRings - 1, j + 1)});
    for (std::uint32_t i = 0; i + 1 < kRings; ++i) {
      const std::uint32_t a = at(i, j);
      const std::uint32_t b = at(i, j + 1);
      const std::uint32_t c = at(i + 1, j + 1);
      const std::uint32_t d = at(i + 1, j);
      if ((i * 7 + j * 5) % 3 == 0) {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({b, c, d});
      } else {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      }
    }
  }
  ASSERT_TRUE(is_closed(mesh));
  EXPECT_FALSE(near_hull(mesh, 0.001));
  const auto hull = near_hull(mesh, 0.1);
  ASSERT_TRUE(hull);
  EXPECT_GT(signed_volume(*hull), signed_volume(mesh));
}

}  // namespace
}  // namespace lamina::csg
