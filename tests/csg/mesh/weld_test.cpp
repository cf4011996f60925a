#include "csg/mesh/weld.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include <gtest/gtest.h>

#include "csg/mesh/edge_table.h"
#include "csg/mesh/mesh_facts.h"
#include "tests/csg/scan_meshes.h"

namespace lamina::csg {
namespace {

// Two squares beside each other, the second shifted along x.
Mesh squares(double gap) {
  Mesh mesh;
  for (const double x : {0.0, 1 + gap}) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const auto& [u, v] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
      mesh.vertices.emplace_back(x + u, v, 0);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
  return mesh;
}

TEST(Weld, JoinsEdgesWithinTheTolerance) {
  Mesh mesh = squares(0.001);
  const Weld done = weld(mesh, 0.002);
  EXPECT_EQ(done.joined_edges, 2U);
  EXPECT_NEAR(done.distance, 0.001, 1e-12);
  EXPECT_EQ(measure(mesh).vertices, 6U);
}

TEST(Weld, LeavesAWiderGap) {
  Mesh mesh = squares(0.003);
  const Mesh before = mesh;
  EXPECT_EQ(weld(mesh, 0.002).joined_edges, 0U);
  EXPECT_EQ(mesh, before);
}

// Four triangles on four parallel edges, the inner two of which are nearer to
// each other than the tolerance, but each has a nearer partner.
TEST(Weld, JoinsTheNearestFirst) {
  Mesh mesh;
  for (const double x : {0.0, 0.0001, 0.0010, 0.0011}) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(
        mesh.vertices.end(),
        {{x, 0, 0}, {x, 1, 0}, {std::cos(first), 0.5, std::sin(first)}});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_NEAR(weld(mesh, 0.002).distance, 0.0001, 1e-12);
  EXPECT_EQ(measure(mesh).vertices, 8U);
}

TEST(Weld, PutsCornersIntoEdgesTheyLieAlong) {
  Mesh mesh = squares(0);
  // The second square ends its left side in three parts.
  mesh.triangles.pop_back();
  mesh.vertices.insert(mesh.vertices.end(),
                       {{1.0005, 0.25, 0}, {0.9995, 0.75, 0}});
  for (const auto& [from, to] : {std::pair(7, 9), {9, 8}, {8, 4}}) {
    mesh.triangles.push_back(
        {6, static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to)});
  }
  const Weld done = weld(mesh, 0.002);
  EXPECT_EQ(done.joined_edges, 4U);
  EXPECT_NEAR(done.distance, 0.0005, 1e-9);
  const MeshFacts facts = measure(mesh);
  EXPECT_EQ(facts.components, 1U);
  EXPECT_EQ(facts.boundary_loops, 1U);
  EXPECT_EQ(facts.open_edges, 6U);
}

TEST(Weld, JoinsATriangleThatIsThereTwiceToItsNeighbours) {
  Mesh mesh = test::ball(10, 4);
  const std::array<std::uint32_t, 3> triangle = mesh.triangles.back();
  mesh.triangles.pop_back();
  for (const double shift : {0.0005, 0.0004}) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const std::uint32_t corner : triangle) {
      mesh.vertices.push_back(mesh.vertices[corner] + shift);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  const Weld done = weld(mesh, 0.002);
  EXPECT_EQ(done.repeated_triangles, 1U);
  EXPECT_FALSE(EdgeTable::of(mesh).is_open());
}

TEST(Weld, KeepsEdgesThatAreShorterThanTheTolerance) {
  Mesh mesh = test::ball(0.01, 4);
  mesh.triangles.pop_back();
  const Mesh before = mesh;
  weld(mesh, 0.1);
  EXPECT_EQ(mesh, before);
}

TEST(WeldTolerance, FollowsSizeAndPlace) {
  EXPECT_DOUBLE_EQ(weld_tolerance(test::box(Vec3(0), Vec3(100), 1)), 0.004);
  EXPECT_DOUBLE_EQ(weld_tolerance(test::box(Vec3(0), Vec3(1), 1)),
                   2e-4 * std::sqrt(3));
  EXPECT_DOUBLE_EQ(weld_tolerance(test::box(Vec3(9900), Vec3(10000), 1)), 0.02);
  EXPECT_EQ(weld_tolerance({}), 0);
}

}  // namespace
}  // namespace lamina::csg
