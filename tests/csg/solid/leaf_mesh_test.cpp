#include "csg/solid/leaf_mesh.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "csg/solid/lower.h"
#include "tests/csg/solid/mesh_checks.h"
#include "tests/csg/solid/tree_builder.h"

namespace lamina::csg {
namespace {

Scene lower_solid(const Tree& tree) {
  Diagnostics diagnostics;
  Lowered lowered = lower(tree, {}, diagnostics);
  EXPECT_NE(lowered.scene(), nullptr);
  return std::move(std::get<Scene>(lowered.geometry));
}

// Of the only instance, in the world.
double instance_volume(const Scene& scene) {
  EXPECT_EQ(scene.instances.size(), 1u);
  const Instance& instance = scene.instances[0];
  const Mesh mesh = explicit_mesh(scene.leaves[instance.leaf]);
  EXPECT_TRUE(is_closed(mesh));
  const Affine& m = instance.world_from_leaf;
  return signed_volume(mesh) * glm::dot(m[0], glm::cross(m[1], m[2]));
}

double polygon_area(int n) {
  return n / 2.0 * std::sin(2 * std::numbers::pi / n);
}

TEST(ExplicitMesh, CubeHasItsVolume) {
  TreeBuilder b;
  const Tree tree = b.tree({b.cube({2, 3, 5}, true)});
  EXPECT_DOUBLE_EQ(instance_volume(lower_solid(tree)), 30);
}

TEST(ExplicitMesh, CylinderIsAPrismOverItsPolygon) {
  TreeBuilder b;
  const Tree tree = b.tree({b.cylinder(4, 3, 3, 7)});
  EXPECT_NEAR(instance_volume(lower_solid(tree)), 4 * 9 * polygon_area(7),
              1e-12);
}

TEST(ExplicitMesh, ConeIsAFrustumOverItsPolygon) {
  TreeBuilder b;
  for (const double r2 : {0.0, 1.0, 5.0}) {
    const Tree tree = b.tree({b.cylinder(6, 3, r2, 9)});
    const double expected = 6.0 / 3 * polygon_area(9) * (9 + 3 * r2 + r2 * r2);
    EXPECT_NEAR(instance_volume(lower_solid(tree)), expected, 1e-12);
  }
}

TEST(ExplicitMesh, ApexIsOneVertex) {
  TreeBuilder b;
  const Scene scene = lower_solid(b.tree({b.cylinder(6, 3, 0, 9)}));
  EXPECT_EQ(explicit_mesh(scene.leaves[0]).vertices.size(), 10u);
}

TEST(ExplicitMesh, SphereIsAStackOfFrustums) {
  TreeBuilder b;
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
  const Tree tree = b.tree({b.sphere(2, n)});
  EXPECT_NEAR(instance_volume(lower_solid(tree)), 8 * expected, 1e-12);
}

}  // namespace
}  // namespace lamina::csg
