#include "csg/boundary/leaf_mesh.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/csg/lower/lower_fixture.h"
#include "tests/support/formulas.h"

namespace lamina::csg {
namespace {

class ExplicitMeshTest : public LowerFixture {};

using support::polygon_area;

TEST_F(ExplicitMeshTest, CubeHasItsVolume) {
  const Node* node = b.cube({2, 3, 5}, true);
  EXPECT_DOUBLE_EQ(run_volume({node}), 30);
}

TEST_F(ExplicitMeshTest, CylinderIsAPrismOverItsPolygon) {
  const Node* node = b.cylinder(4, 3, 3, 7);
  EXPECT_NEAR(run_volume({node}), 4 * 9 * polygon_area(7), 1e-12);
}

TEST_F(ExplicitMeshTest, ConeIsAFrustumOverItsPolygon) {
  for (const double r2 : {0.0, 1.0, 5.0}) {
    const Node* node = b.cylinder(6, 3, r2, 9);
    const double expected = 6.0 / 3 * polygon_area(9) * (9 + 3 * r2 + r2 * r2);
    EXPECT_NEAR(run_volume({node}), expected, 1e-12);
  }
}

TEST_F(ExplicitMeshTest, ApexIsOneVertex) {
  const Scene scene = run_solid({b.cylinder(6, 3, 0, 9)});
  EXPECT_EQ(explicit_mesh(scene.leaves[0]).vertices.size(), 10u);
}

TEST_F(ExplicitMeshTest, SphereIsAStackOfFrustums) {
  constexpr int n = 11;
  constexpr int rings = (n + 1) / 2;
  const double step = std::numbers::pi / rings;
  double expected = 0;
  for (int i = 0; i + 1 < rings; ++i) {
    const double a = (i + 0.5) * step;
    const double r1 = std::sin(a);
    const double r2 = std::sin(a + step);
    expected += (std::cos(a) - std::cos(a + step)) / 3 * polygon_area(n) *
                (r1 * r1 + r1 * r2 + r2 * r2);
  }
  const Node* node = b.sphere(2, n);
  EXPECT_NEAR(run_volume({node}), 8 * expected, 1e-12);
}

}  // namespace
}  // namespace lamina::csg
