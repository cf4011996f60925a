#include "csg/mesh/manifold_cut.h"

#include <utility>

#include <gtest/gtest.h>

#include "csg/mesh/mesh_facts.h"
#include "tests/csg/scan_meshes.h"

namespace lamina::csg {
namespace {

using test::ball;
using test::box;
using test::doughnut;
using test::joined;
using test::patch;

TEST(MeshFacts, OfClosedSurfacesAreThoseOfTheirShape) {
  const MeshFacts cube = measure(box(Vec3(0), Vec3(2, 3, 4), 5));
  EXPECT_TRUE(cube.is_closed);
  EXPECT_EQ(cube.components, 1U);
  EXPECT_EQ(cube.genus, 0U);
  EXPECT_EQ(cube.boundary_loops, 0U);
  EXPECT_EQ(cube.triangles, 6U * 5 * 5 * 2);
  EXPECT_EQ(cube.vertices, 2 + cube.triangles / 2);
  EXPECT_NEAR(cube.area, 2 * (6 + 8 + 12), 1e-9);
  EXPECT_NEAR(cube.volume, 24, 1e-9);
  EXPECT_EQ(cube.box.low, Vec3(0));
  EXPECT_EQ(cube.box.high, Vec3(2, 3, 4));

  const MeshFacts ring = measure(doughnut(5, 1, 40, 20));
  EXPECT_TRUE(ring.is_closed);
  EXPECT_EQ(ring.components, 1U);
  EXPECT_EQ(ring.genus, 1U);
}

TEST(MeshFacts, CountComponentsAndTheirHandles) {
  const MeshFacts all =
      measure(joined({doughnut(5, 1, 40, 20), ball(0.5, 20),
                      doughnut(20, 1, 40, 20), box(Vec3(50), Vec3(51), 1)}));
  EXPECT_EQ(all.components, 4U);
  EXPECT_EQ(all.genus, 2U);
  EXPECT_TRUE(all.is_closed);
}

TEST(MeshFacts, CountHolesByTheirLoops) {
  Mesh pierced = doughnut(5, 1, 40, 20);
  // Two triangles far from each other.
  pierced.triangles.erase(pierced.triangles.begin() + 700);
  pierced.triangles.erase(pierced.triangles.begin() + 100);
  const MeshFacts facts = measure(pierced);
  EXPECT_FALSE(facts.is_closed);
  EXPECT_EQ(facts.boundary_loops, 2U);
  EXPECT_EQ(facts.open_edges, 6U);
  EXPECT_EQ(facts.genus, 1U);

  const MeshFacts sheet = measure(patch(4, 0));
  EXPECT_EQ(sheet.boundary_loops, 1U);
  EXPECT_EQ(sheet.open_edges, 16U);
  EXPECT_EQ(sheet.genus, 0U);
  EXPECT_EQ(sheet.components, 1U);
}

TEST(MeshFacts, FindWhereASurfaceIsNoManifold) {
  // Two cubes that share an edge, and two that share a corner.
  const MeshFacts edge = measure(
      joined({box(Vec3(0), Vec3(1), 1), box(Vec3(1, 1, 0), Vec3(2, 2, 1), 1)}));
  EXPECT_TRUE(edge.is_closed);
  EXPECT_EQ(edge.tangled_edges, 1U);
  EXPECT_EQ(edge.tangled_vertices, 2U);
  EXPECT_EQ(edge.components, 2U);
  EXPECT_EQ(edge.genus, 0U);
  EXPECT_EQ(edge.boundary_loops, 0U);

  const MeshFacts corner =
      measure(joined({box(Vec3(0), Vec3(1), 1), box(Vec3(1), Vec3(2), 1)}));
  EXPECT_TRUE(corner.is_closed);
  EXPECT_EQ(corner.tangled_edges, 0U);
  EXPECT_EQ(corner.tangled_vertices, 1U);
  EXPECT_EQ(corner.components, 2U);
  EXPECT_EQ(corner.genus, 0U);
}

TEST(MeshFacts, SeeFacesThatAreTurned) {
  Mesh turned = box(Vec3(0), Vec3(1), 1);
  std::swap(turned.triangles[3][1], turned.triangles[3][2]);
  const MeshFacts facts = measure(turned);
  EXPECT_FALSE(facts.is_closed);
  EXPECT_EQ(facts.tangled_edges, 3U);
  EXPECT_EQ(facts.open_edges, 0U);
}

TEST(ManifoldCut, SewnTogetherIsTheMesh) {
  const Mesh mesh =
      joined({box(Vec3(0), Vec3(1), 2), box(Vec3(1, 1, 0), Vec3(2, 2, 1), 2)});
  const ManifoldCut cut = cut_to_manifold(mesh);
  ASSERT_EQ(cut.mesh.triangles.size(), mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t copy = cut.mesh.triangles[i][k];
      EXPECT_EQ(cut.origins[copy], mesh.triangles[i][k]);
      EXPECT_EQ(cut.mesh.vertices[copy], mesh.vertices[mesh.triangles[i][k]]);
    }
  }
  EXPECT_GT(cut.mesh.vertices.size(), mesh.vertices.size());
}

}  // namespace
}  // namespace lamina::csg
