#include "csg/boundary/near_hull.h"

#include <cstdint>

#include <gtest/gtest.h>

#include "csg/boundary/leaf_mesh.h"
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

}  // namespace
}  // namespace lamina::csg
