// Decimation held against the formulas of the shapes that were scanned. The
// distance of whole surfaces from each other is judged by CGAL in tests/oracle.

#include "csg/import/decimate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "base/diagnostic.h"
#include "csg/mesh/mesh_facts.h"
#include "tests/csg/scan_meshes.h"

namespace lamina::csg {
namespace {

using test::ball;
using test::box;
using test::doughnut;
using test::joined;
using test::patch;

Decimation thin_out(Mesh& mesh, double tolerance) {
  Diagnostics diagnostics;
  return decimate(mesh, tolerance, {LAMINA_MODULES}, diagnostics);
}

// Calls look(point) for points all over the triangles.
template <typename Look>
void for_points_of(const Mesh& mesh, Look look) {
  constexpr int kSteps = 6;
  for (const auto& t : mesh.triangles) {
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; i + j <= kSteps; ++j) {
        look((mesh.vertices[t[0]] * double(i) +
              mesh.vertices[t[1]] * double(j) +
              mesh.vertices[t[2]] * double(kSteps - i - j)) /
             double(kSteps));
      }
    }
  }
}

TEST(Decimate, ABallStaysWithinTheToleranceOfTheBall) {
  const Mesh scan = ball(5, 60);
  for (const double tolerance : {0.005, 0.02, 0.1}) {
    Mesh mesh = scan;
    const Decimation done = thin_out(mesh, tolerance);
    EXPECT_EQ(done.triangles_before, scan.triangles.size());
    EXPECT_EQ(done.triangles_after, mesh.triangles.size());
    EXPECT_LT(done.triangles_after, done.triangles_before / 2);
    // Facets of the scan stand inside of the ball themselves.
    constexpr double kFacetDepth = 0.005;
    for_points_of(mesh, [&](const Vec3& point) {
      EXPECT_LE(glm::length(point), 5 + 1e-9);
      EXPECT_GE(glm::length(point), 5 - tolerance - kFacetDepth);
    });
    const MeshFacts facts = measure(mesh);
    EXPECT_TRUE(facts.is_closed);
    EXPECT_EQ(facts.genus, 0U);
    EXPECT_EQ(facts.components, 1U);
    EXPECT_LE(measure(scan).volume - facts.volume,
              tolerance * 4 * std::numbers::pi * 25);
  }
}

TEST(Decimate, ATorusKeepsItsHoleAndItsDistance) {
  Mesh mesh = doughnut(5, 1, 300, 120);
  thin_out(mesh, 0.02);
  const MeshFacts facts = measure(mesh);
  EXPECT_TRUE(facts.is_closed);
  EXPECT_EQ(facts.genus, 1U);
  EXPECT_LT(facts.triangles, 300U * 120 * 2 / 5);
  for_points_of(mesh, [](const Vec3& point) {
    const double tube = std::hypot(std::hypot(point.x, point.y) - 5, point.z);
    EXPECT_NEAR(tube, 1, 0.02 + 0.003);  // and the depth of the scan's facets
  });
}

TEST(Decimate, FlatSidesNeedFewTriangles) {
  Mesh mesh = box(Vec3(0), Vec3(10, 20, 30), 30);
  thin_out(mesh, 0.001);
  const MeshFacts facts = measure(mesh);
  EXPECT_TRUE(facts.is_closed);
  EXPECT_LT(facts.triangles, 400U);  // of 10,800
  EXPECT_NEAR(facts.volume, 6000, 1e-6);
  EXPECT_NEAR(facts.area, 2200, 1e-6);
}

TEST(Decimate, AnOpenMeshKeepsItsBoundary) {
  Mesh mesh = patch(20, 3);
  thin_out(mesh, 0.01);
  const MeshFacts facts = measure(mesh);
  EXPECT_EQ(facts.boundary_loops, 1U);
  EXPECT_EQ(facts.open_edges, 80U);
  EXPECT_NEAR(facts.area, 400, 1e-9);
  EXPECT_LT(facts.triangles, 20U * 20 * 2 / 3);
}

TEST(Decimate, WhereAMeshIsNoManifoldItStaysAndIsCounted) {
  const Mesh scan = joined(
      {box(Vec3(0), Vec3(10), 10), box(Vec3(10, 10, 0), Vec3(20, 20, 10), 10)});
  Mesh mesh = scan;
  const Decimation done = thin_out(mesh, 0.01);
  EXPECT_EQ(done.tangled_edges, 10U);
  EXPECT_EQ(done.tangled_vertices, 11U);
  const MeshFacts facts = measure(mesh);
  EXPECT_TRUE(facts.is_closed);
  EXPECT_EQ(facts.tangled_edges, 10U);
  EXPECT_NEAR(facts.volume, 2000, 1e-6);
  EXPECT_LT(facts.triangles, measure(scan).triangles / 3);
}

TEST(Decimate, FansOfThousandsOfTrianglesTakeNoTime) {
  // A cone of 200,000 sides and its bottom: fans as wide as that.
  constexpr std::uint32_t kSides = 200'000;
  Mesh mesh{{Vec3(0, 0, 3), Vec3(0)}, {}};
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    mesh.vertices.emplace_back(std::cos(angle), std::sin(angle), 0);
    const std::uint32_t here = 2 + i;
    const std::uint32_t next = 2 + (i + 1) % kSides;
    mesh.triangles.push_back({0, here, next});
    mesh.triangles.push_back({1, next, here});
  }
  thin_out(mesh, 0.01);
  EXPECT_TRUE(measure(mesh).is_closed);
}

TEST(Decimate, TheSameMeshGivesTheSameTriangles) {
  Mesh first = ball(5, 20);
  test::shake(first, 0.01);
  Mesh second = first;
  thin_out(first, 0.03);
  thin_out(second, 0.03);
  EXPECT_EQ(first, second);
}

TEST(Decimate, SaysWhereTheModuleWasLookedFor) {
  Mesh mesh = box(Vec3(0), Vec3(1), 2);
  Diagnostics diagnostics;
  try {
    decimate(mesh, 0.1, {"/nowhere", "/neither"}, diagnostics);
    FAIL() << "no error";
  } catch (const GeometryError& error) {
    EXPECT_STREQ(error.what(),
                 "Can't find the module for decimation, lamina_decimate.so, in "
                 "/nowhere or /neither");
  }
}

}  // namespace
}  // namespace lamina::csg
