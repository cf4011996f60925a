// Decimation judged by CGAL: each surface lies within the tolerance of the
// other one, everywhere and not only at vertices.

#include "csg/import/decimate.h"

#include <gtest/gtest.h>

#include "csg/mesh/mesh_facts.h"
#include "tests/csg/scan_meshes.h"
#include "tests/oracle/surface_distance.h"

namespace lamina::oracle {
namespace {

namespace shapes = csg::test;

void expect_within(const csg::Mesh& scan, double tolerance) {
  csg::Mesh mesh = scan;
  Diagnostics diagnostics;
  csg::decimate(mesh, tolerance, {LAMINA_MODULES}, diagnostics);
  EXPECT_LT(mesh.triangles.size(), scan.triangles.size());
  const double error = tolerance / 50;
  EXPECT_LE(surface_distance(scan, mesh, error), tolerance + error);
  EXPECT_LE(surface_distance(mesh, scan, error), tolerance + error);
  EXPECT_TRUE(csg::measure(mesh).is_closed);
  EXPECT_EQ(csg::measure(mesh).genus, csg::measure(scan).genus);
}

TEST(DecimateOracle, SmoothShapesStayWithinTheTolerance) {
  for (const double tolerance : {0.01, 0.1}) {
    expect_within(shapes::ball(5, 25), tolerance);
    expect_within(shapes::doughnut(5, 1, 120, 40), tolerance);
  }
}

TEST(DecimateOracle, EdgesAndCornersStayWithinTheTolerance) {
  csg::Mesh cube = shapes::box(Vec3(0), Vec3(4), 20);
  expect_within(cube, 0.05);
  shapes::shake(cube, 0.03);
  expect_within(cube, 0.05);
}

// Noise as large as the distance of points, where surfaces fold.
TEST(DecimateOracle, NoiseStaysWithinTheTolerance) {
  for (const double noise : {0.01, 0.05, 0.2}) {
    csg::Mesh scan = shapes::doughnut(5, 1, 120, 40);
    shapes::shake(scan, noise);
    expect_within(scan, 0.05);
    expect_within(scan, 0.2);
  }
}

TEST(DecimateOracle, TheJudgeKnowsTheDistanceOfParallelPlanes) {
  const csg::Mesh low = shapes::patch(3, 0);
  const csg::Mesh high = shapes::patch(3, 0.25);
  EXPECT_NEAR(surface_distance(low, high, 1e-4), 0.25, 1e-4);
}

}  // namespace
}  // namespace lamina::oracle
