#include "csg/mesh/fill_hole.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "csg/mesh/edge_table.h"
#include "csg/mesh/mesh_facts.h"

namespace lamina::csg {
namespace {

// A loop around all vertices.
MeshFacts fill(std::vector<Vec3> vertices) {
  Mesh mesh;
  mesh.vertices = std::move(vertices);
  std::vector<std::uint32_t> loop(mesh.vertices.size());
  std::iota(loop.begin(), loop.end(), 0U);
  fill_hole(mesh, loop);
  EXPECT_EQ(mesh.triangles.size(), loop.size() - 2);
  const MeshFacts facts = measure(mesh);
  EXPECT_EQ(facts.open_edges, loop.size());
  EXPECT_EQ(facts.boundary_loops, 1U);
  EXPECT_EQ(facts.tangled_edges, 0U);
  return facts;
}

// Out along an arc of a circle and back beside it.
std::vector<Vec3> crack(int steps, double radius, double width) {
  std::vector<Vec3> rim;
  const auto point = [&](int i, double y) {
    const double angle = 1.5 * std::numbers::pi * i / steps;
    return Vec3(radius * std::cos(angle), y, radius * std::sin(angle));
  };
  for (int i = 0; i <= steps; ++i) rim.push_back(point(i, 0));
  for (int i = steps; i >= 0; --i) rim.push_back(point(i, width));
  return rim;
}

TEST(FillHole, OfAPolygonHasItsArea) {
  // An L, of which no corner sees all others.
  EXPECT_NEAR(
      fill({{0, 0, 1}, {3, 0, 1}, {3, 1, 1}, {1, 1, 1}, {1, 3, 1}, {0, 3, 1}})
          .area,
      5, 1e-12);
}

TEST(FillHole, EndsWhereAreasAreBeyondAllNumbers) {
  fill({{0, 0, 0},
        {1e200, 0, 0},
        {1e200, 1e200, 1e199},
        {0, 1e200, 0},
        {-1e200, 0, 1e200}});
}

TEST(FillHole, FollowsACrackThatIsBent) {
  for (const int steps : {5, 40, 300, 3000}) {
    const double width = 0.01;
    const double length =
        2 * 10 * std::sin(0.75 * std::numbers::pi / steps) * steps;
    EXPECT_NEAR(fill(crack(steps, 10, width)).area, length * width,
                1e-6 * length * width)
        << steps;
  }
}

}  // namespace
}  // namespace lamina::csg
