#include "ldni/section/leaf_section.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "csg/scene.h"
#include "ldni/section/grid.h"
#include "tests/ldni/support/scene_builder.h"
#include "tests/support/formulas.h"

namespace lamina::ldni {
namespace {

using namespace lamina::testing;

constexpr double kPi = std::numbers::pi;

// Area that the chains of a layer enclose, counted by winding.
double winding_area(const plane::ChainBlock& block, std::uint32_t layer) {
  double area = 0;
  for (const plane::Chain& chain : block.layer(layer)) {
    for (std::uint32_t i = 1; i < chain.point_count; ++i) {
      const Vec2& a = block.points[chain.first_point + i - 1];
      const Vec2& b = block.points[chain.first_point + i];
      area -= chain.winding * (b.x - a.x) * (a.y + b.y) / 2;
    }
  }
  return area;
}

csg::Scene scene_of(const csg::Leaf& leaf, const Affine& placement) {
  SceneBuilder builder;
  builder.add(leaf, placement);
  return builder.finish();
}

double area_at(const csg::Leaf& leaf, const Affine& placement, double height) {
  const csg::Scene scene = scene_of(leaf, placement);
  const LayerGrid grid = LayerGrid::at_heights({height});
  const LeafSectioner sectioner(scene, grid);
  ldni::SectionBlock block;
  sectioner.cut(0, 1, block);
  EXPECT_EQ(block.open_paths, 0U);
  return winding_area(block, 0);
}

using support::polygon_area;

const Affine kIdentity(1.0);

TEST(LeafSection, ACubeIsItsBaseAtEveryHeightFromBottomToTop) {
  const csg::Leaf cube = cube_leaf({2, 3, 4});
  for (const double height : {0.0, 1.0, 3.999}) {
    EXPECT_DOUBLE_EQ(area_at(cube, kIdentity, height), 6) << height;
  }
  // A section stands for the solid just above it: [bottom, top).
  EXPECT_EQ(area_at(cube, kIdentity, 4), 0);
  EXPECT_EQ(area_at(cube, kIdentity, -1e-6), 0);
}

TEST(LeafSection, AConeShrinksWithTheSquareOfItsHeight) {
  const csg::Leaf cone = cylinder_leaf(3, 0, 2, 48);
  for (const double height : {0.0, 0.5, 1.0, 1.9}) {
    const double radius = 3 * (1 - height / 2);
    EXPECT_NEAR(area_at(cone, kIdentity, height),
                polygon_area(48) * radius * radius, 1e-12);
  }
}

TEST(LeafSection, AConeCutAlongItsAxisIsATriangle) {
  const csg::Leaf cone = cylinder_leaf(3, 0, 2, 48);
  const Affine lying = rotated(90, {1, 0, 0});
  EXPECT_NEAR(area_at(cone, lying, 0), 6, 1e-12);
}

TEST(LeafSection, ASphereIsARegularPolygonBetweenItsRings) {
  const int facets = 30;
  const csg::Leaf sphere = sphere_leaf(5, facets);
  const std::vector<Vec2>& profile = sphere.lofts[0].profile;
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const double height = 0.25 * profile[i].y + 0.75 * profile[i + 1].y;
    const double radius = 0.25 * profile[i].x + 0.75 * profile[i + 1].x;
    EXPECT_NEAR(area_at(sphere, kIdentity, height),
                polygon_area(facets) * radius * radius, 1e-11);
  }
}

TEST(LeafSection, ATorusIsARingAcrossItsAxisAndTwoDiscsAlongIt) {
  const csg::Leaf torus = torus_leaf(5, 1, 60, 40);
  // At mid height the profile reaches from 4 to 6.
  EXPECT_NEAR(area_at(torus, kIdentity, 0), polygon_area(60) * (36 - 16),
              1e-11);
  // Through the axis: two copies of the profile; the outline has corners at 0
  // and 180 degrees.
  EXPECT_NEAR(area_at(torus, rotated(90, {1, 0, 0}), 0), 2 * polygon_area(40),
              1e-11);
}

TEST(LeafSection, ATiltedCylinderCutThroughItsSideIsAStretchedPolygon) {
  const csg::Leaf cylinder = cylinder_leaf(2, 2, 100, 36);
  for (const double tilt : {10.0, 45.0, 80.0}) {
    const Affine placement = rotated(tilt, {1, 0, 0}) * translated({0, 0, -50});
    EXPECT_NEAR(area_at(cylinder, placement, 0.3),
                4 * polygon_area(36) / std::cos(tilt * kPi / 180), 1e-9)
        << tilt;
  }
}

TEST(LeafSection, ALyingPrismWithANonConvexCapKeepsItsProngs) {
  // An E: its section across the prongs is three rectangles or one.
  const std::vector<Vec2> letter = {{0, 0}, {4, 0}, {4, 1}, {1, 1},
                                    {1, 2}, {4, 2}, {4, 3}, {1, 3},
                                    {1, 4}, {4, 4}, {4, 5}, {0, 5}};
  const csg::Leaf prism = extrusion_leaf(letter, 10);
  // x becomes the height.
  const Affine standing = rotated(-90, {0, 1, 0});
  EXPECT_NEAR(area_at(prism, standing, 2.5), 3 * 10, 1e-9);
  EXPECT_NEAR(area_at(prism, standing, 0.5), 5 * 10, 1e-9);
  // y becomes the height: prong, spine, prong, spine, prong.
  const Affine lying = rotated(90, {1, 0, 0});
  EXPECT_NEAR(area_at(prism, lying, 0.5), 4 * 10, 1e-9);
  EXPECT_NEAR(area_at(prism, lying, 1.5), 1 * 10, 1e-9);
}

TEST(LeafSection, ACavityIsTakenOffTheArea) {
  csg::Leaf tube = extrusion_leaf({{0, 0}, {6, 0}, {6, 6}, {0, 6}}, 3);
  tube.lofts.push_back(
      extrusion_leaf({{2, 2}, {4, 2}, {4, 4}, {2, 4}}, 3).lofts[0]);
  tube.lofts.back().is_cavity = true;
  EXPECT_NEAR(area_at(tube, kIdentity, 1), 36 - 4, 1e-12);
  EXPECT_NEAR(area_at(tube, scaled({-1, 1, 1}), 1), 36 - 4, 1e-12);
}

// Leaves of every kind, convex or not.
std::vector<csg::Leaf> all_kinds() {
  csg::Leaf hourglass = cylinder_leaf(2, 2, 1, 9);
  hourglass.lofts[0].profile = {{0, 0}, {2, 0.5}, {1, 1}, {2.5, 2}, {0, 3}};
  return {cube_leaf({1, 2, 3}),
          cylinder_leaf(2, 1, 3, 7),
          cylinder_leaf(0, 1, 3, 12),
          sphere_leaf(2, 11),
          torus_leaf(2, 0.7, 13, 8),
          hourglass,
          extrusion_leaf({{0, 0}, {3, 0}, {3, 3}, {2, 1}, {1, 3}, {0, 2}}, 2)};
}

TEST(LeafSection, TurningTheLeafAroundZOrMirroringItKeepsTheArea) {
  for (const csg::Leaf& leaf : all_kinds()) {
    const Affine tilt = rotated(33, {1, 2, 3});
    for (const double height : {-0.7, 0.1, 0.4, 1.3}) {
      const double area = area_at(leaf, tilt, height);
      EXPECT_NEAR(area_at(leaf, rotated(71, {0, 0, 1}) * tilt, height), area,
                  1e-9);
      EXPECT_NEAR(area_at(leaf, scaled({-1, 1, 1}) * tilt, height), area, 1e-9);
      EXPECT_NEAR(area_at(leaf, translated({3, -5, 0}) * tilt, height), area,
                  1e-9);
      EXPECT_GE(area, 0);
    }
  }
}

TEST(LeafSection, ALoftAndTheMeshOfItsFacetsEncloseTheSame) {
  for (const csg::Leaf& leaf : all_kinds()) {
    const csg::Leaf mesh = as_mesh(leaf);
    for (const double tilt : {0.0, 20.0, 77.0, 90.0, 180.0}) {
      const Affine placement = rotated(tilt, {1, 0.3, 0});
      for (double height = -3; height < 3; height += 0.2371) {
        EXPECT_NEAR(area_at(leaf, placement, height),
                    area_at(mesh, placement, height), 1e-9)
            << tilt << ' ' << height;
      }
    }
  }
}

TEST(LeafSection, TheSumOfTheLayersIsTheVolume) {
  const csg::Leaf torus = torus_leaf(4, 1, 40, 24);
  // Pappus for a polygon turned on a polygonal outline: scale² integrates.
  double volume = 0;
  const std::vector<Vec2>& profile = torus.lofts[0].profile;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const Vec2& a = profile[i];
    const Vec2& b = profile[(i + 1) % profile.size()];
    volume += (b.y - a.y) * (a.x * a.x + a.x * b.x + b.x * b.x) / 3;
  }
  volume *= polygon_area(40);
  const double thickness = 0.001;
  const csg::Scene scene = scene_of(torus, rotated(50, {1, 1, 0}));
  const LayerGrid grid =
      LayerGrid::uniform(scene.box.low.z, scene.box.high.z, thickness);
  const LeafSectioner sectioner(scene, grid);
  ldni::SectionBlock block;
  double sum = 0;
  for (std::uint32_t first = 0; first < grid.layer_count(); first += 64) {
    const std::uint32_t count = std::min(64U, grid.layer_count() - first);
    sectioner.cut(first, count, block);
    for (std::uint32_t l = 0; l < count; ++l) sum += winding_area(block, l);
  }
  EXPECT_NEAR(sum * thickness, volume, 1e-4 * volume);
}

TEST(LeafSection, EveryChainRunsToTheRightAndItsEndsMeetOthers) {
  for (const csg::Leaf& leaf : all_kinds()) {
    const csg::Scene scene = scene_of(leaf, rotated(40, {2, 1, 1}));
    const LayerGrid grid =
        LayerGrid::uniform(scene.box.low.z, scene.box.high.z, 0.05);
    const LeafSectioner sectioner(scene, grid);
    ldni::SectionBlock block;
    sectioner.cut(0, grid.layer_count(), block);
    for (std::uint32_t l = 0; l < block.layer_count; ++l) {
      std::vector<double> ends;
      for (const plane::Chain& chain : block.layer(l)) {
        ASSERT_GE(chain.point_count, 2U);
        ASSERT_EQ(std::abs(chain.winding), 1);
        const Vec2* points = &block.points[chain.first_point];
        for (std::uint32_t i = 1; i < chain.point_count; ++i) {
          ASSERT_LT(points[i - 1].x, points[i].x);
        }
        ends.push_back(points[0].x);
        ends.push_back(points[chain.point_count - 1].x);
      }
      std::sort(ends.begin(), ends.end());
      ASSERT_EQ(ends.size() % 2, 0U);
      for (std::size_t i = 0; i < ends.size(); i += 2) {
        ASSERT_EQ(ends[i], ends[i + 1]);  // exactly
      }
    }
  }
}

void expect_the_same_in_every_block(const csg::Scene& scene) {
  const LayerGrid grid =
      LayerGrid::uniform(scene.box.low.z, scene.box.high.z, 0.1);
  const LeafSectioner sectioner(scene, grid);
  ldni::SectionBlock whole;
  sectioner.cut(0, grid.layer_count(), whole);
  ldni::SectionBlock single;
  for (std::uint32_t l = 0; l < grid.layer_count(); ++l) {
    sectioner.cut(l, 1, single);
    const auto expected = whole.layer(l);
    const auto actual = single.layer(0);
    ASSERT_EQ(actual.size(), expected.size());
    for (std::size_t i = 0; i < actual.size(); ++i) {
      ASSERT_EQ(actual[i].operand, expected[i].operand);
      ASSERT_EQ(actual[i].winding, expected[i].winding);
      ASSERT_EQ(actual[i].point_count, expected[i].point_count);
      for (std::uint32_t k = 0; k < actual[i].point_count; ++k) {
        ASSERT_EQ(single.points[actual[i].first_point + k],
                  whole.points[expected[i].first_point + k]);
      }
    }
  }
}

TEST(LeafSection, ALayerIsTheSameInEveryBlock) {
  SceneBuilder builder;
  for (int i = 0; i < 40; ++i) {
    builder.add(sphere_leaf(0.3 + 0.1 * i, 8 + i),
                translated({0.3 * i, 0, 0.21 * i}));
  }
  expect_the_same_in_every_block(builder.finish());
}

// Whatever the order of its triangles and however its instances are turned.
TEST(LeafSection, ALayerOfAMeshIsTheSameInEveryBlock) {
  csg::Leaf leaf = as_mesh(torus_leaf(4, 1, 60, 40));
  std::mt19937 random(1);
  for (const bool is_shuffled : {false, true}) {
    auto& triangles = leaf.meshes[0].triangles;
    if (is_shuffled) std::shuffle(triangles.begin(), triangles.end(), random);
    SceneBuilder builder;
    builder.add(leaf);
    for (const double angle : {33.0, 90.0, 180.0}) {
      builder.add_instance(
          0, translated({angle / 10, 0, 1}) * rotated(angle, {1, 0.4, 0.2}));
    }
    expect_the_same_in_every_block(builder.finish());
  }
}

TEST(LeafSection, AnOpenMeshIsClosedAndCounted) {
  csg::Leaf leaf = as_mesh(cube_leaf({1, 1, 1}));
  leaf.meshes[0].triangles.erase(leaf.meshes[0].triangles.begin() + 2);
  const csg::Scene scene = scene_of(leaf, kIdentity);
  const LayerGrid grid = LayerGrid::at_heights({0.25, 0.75});
  const LeafSectioner sectioner(scene, grid);
  ldni::SectionBlock block;
  sectioner.cut(0, 2, block);
  EXPECT_EQ(block.open_paths, 2U);
  EXPECT_GT(winding_area(block, 0), 0.5);
}

}  // namespace
}  // namespace lamina::ldni
