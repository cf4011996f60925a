#include "csg/mesh/edge_table.h"

#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace lamina::csg {
namespace {

// A mesh of these triangles; only the number of vertices matters.
Mesh mesh_of(std::size_t vertex_count,
             std::vector<std::array<std::uint32_t, 3>> triangles) {
  return {std::vector<Vec3>(vertex_count), std::move(triangles)};
}

Mesh tetrahedron() {
  return mesh_of(4, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
}

// Every edge as "low-high:", then its faces, each with + where it rises.
std::string edges_of(const EdgeTable& table) {
  std::string text;
  table.for_each_edge([&](std::uint32_t low, std::span<const Side> sides) {
    text += fmt::format("{}-{}:", low, sides[0].high);
    for (const Side& side : sides) {
      text += fmt::format(" {}{}", side.is_rising() ? '+' : '-', side.face());
    }
    text += '\n';
  });
  return text;
}

TEST(EdgeTable, VisitsEdgesByTheirVerticesAndSidesByTheirFaces) {
  EXPECT_EQ(edges_of(EdgeTable::of(tetrahedron())),
            "0-1: -0 +1\n"
            "0-2: +0 -2\n"
            "0-3: -1 +2\n"
            "1-2: -0 +3\n"
            "1-3: +1 -3\n"
            "2-3: -2 +3\n");
}

TEST(EdgeTable, GathersAllSidesOfAnEdgeThatFourTrianglesShare) {
  const Mesh mesh = mesh_of(6, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {1, 0, 5}});
  EXPECT_TRUE(edges_of(EdgeTable::of(mesh)).starts_with("0-1: +0 -1 +2 -3\n"));
}

TEST(EdgeTable, TakesFacesOfAnyNumberOfCorners) {
  const EdgeTable table = EdgeTable::make(4, [](auto visit) {
    for (std::uint32_t i = 0; i < 4; ++i) visit(0, i, (i + 1) % 4);
  });
  EXPECT_EQ(edges_of(table), "0-1: +0\n0-3: -0\n1-2: +0\n2-3: +0\n");
}

TEST(EdgeTable, IsOpenWhereAnEdgeHasNoPartner) {
  Mesh mesh = tetrahedron();
  EXPECT_FALSE(EdgeTable::of(mesh).is_open());
  mesh.triangles.pop_back();
  EXPECT_TRUE(EdgeTable::of(mesh).is_open());
}

TEST(EdgeTable, IsClosedHoweverTrianglesAreTurned) {
  Mesh mesh = tetrahedron();
  std::swap(mesh.triangles[2][0], mesh.triangles[2][1]);
  EXPECT_FALSE(EdgeTable::of(mesh).is_open());
}

TEST(EdgeTable, HasNoEdgesWithoutTriangles) {
  EXPECT_EQ(edges_of(EdgeTable::of(mesh_of(3, {}))), "");
  EXPECT_FALSE(EdgeTable::of(mesh_of(0, {})).is_open());
}

}  // namespace
}  // namespace lamina::csg
