// hull(), against volumes known otherwise.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "csg/boundary/boundary_faces.h"
#include "csg/boundary/convex_hull.h"
#include "tests/csg/lower/lower_fixture.h"
#include "tests/csg/lower/mesh_checks.h"

namespace lamina::csg {
namespace {

using Hulls = LowerFixture;

constexpr double kHullRounding = 1e-9;

TEST(ConvexHull, OfPointsThatSpanNoVolumeIsNothing) {
  EXPECT_TRUE(convex_hull(std::vector<Vec3>()).triangles.empty());
  EXPECT_TRUE(convex_hull({{1, 2, 3}, {1, 2, 3}}).triangles.empty());
  EXPECT_TRUE(
      convex_hull({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {5, 5, 5}})
          .triangles.empty());
  EXPECT_TRUE(
      convex_hull({{0, 0, 7}, {1, 0, 7}, {1, 1, 7}, {0, 1, 7}, {2, 5, 7}})
          .triangles.empty());
}

TEST(ConvexHull, OfAGridIsItsBox) {
  std::vector<Vec3> points;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 7; ++j) {
      for (int k = 0; k < 8; ++k) points.emplace_back(i, j, k);
    }
  }
  const Mesh mesh = convex_hull(points);
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_DOUBLE_EQ(signed_volume(mesh), 5 * 6 * 7);
}

TEST(ConvexHull, LeavesOutPointsThatAreNotFinite) {
  const double infinity = HUGE_VAL;
  EXPECT_EQ(convex_hull({{0, 0, 0},
                         {1, 0, 0},
                         {0, 1, 0},
                         {0, 0, 1},
                         {infinity, 0, 0},
                         {0, std::nan(""), 0}})
                .vertices.size(),
            4u);
}

TEST(ConvexHull, KeepsItsShapeFarFromTheOrigin) {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) {
    points.push_back(Vec3(1e6) + Vec3(i & 1, i >> 1 & 1, i >> 2) * 0.001);
  }
  const Mesh mesh = convex_hull(points);
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_EQ(mesh.vertices.size(), 8u);
}

// Rows along all directions, rounded as sums of products are.
TEST(FlatHull, OfARowIsItsEndsWhateverRoundingDoes) {
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto vector = [&] {
    return Vec3(number(random), number(random), number(random));
  };
  for (int trial = 0; trial < 3000; ++trial) {
    SCOPED_TRACE(trial);
    const int axis = trial % 4;
    Vec3 along = 10.0 * vector();
    for (int i = 0; axis < 3 && i < 3; ++i) along[i] = i == axis ? 1 : 0;
    const Vec3 start = vector();
    std::vector<Vec3> row;
    for (int i = 0; i < 9; ++i) {
      const Vec3 away = 10.0 * vector();
      row.push_back((start + along * (i * 0.1) + away) - away);
    }
    const std::vector<Vec3> ends = {row.front(), row.back()};
    std::ranges::shuffle(row, random);
    std::vector<Vec3> flat = flat_hull(row).corners;
    ASSERT_EQ(flat.size(), 2u);
    if (glm::dot(flat[1] - flat[0], along) < 0) std::swap(flat[0], flat[1]);
    EXPECT_EQ(flat, ends);
  }
}

TEST_F(Hulls, OfOneConvexLeafIsThatLeaf) {
  EXPECT_NEAR(run_volume({b.node(Hull{}, {b.cube({2, 3, 4})})}), 24,
              kHullRounding);
  const double sphere = run_volume({b.sphere(5, 40)});
  EXPECT_NEAR(run_volume({b.node(Hull{}, {b.sphere(5, 40)})}), sphere,
              kHullRounding);
}

// A prism over the hull of two squares: 1 + 1 + the band between them.
TEST_F(Hulls, OfTwoCubesIsThePrismBetweenThem) {
  const double volume = run_volume(
      {b.node(Hull{}, {b.cube({1, 1, 1}),
                       b.translate({3, 3, 0}, {b.cube({1, 1, 1})})})});
  EXPECT_NEAR(volume, 1 + 6, kHullRounding);
}

// V(A ⊕ segment) = V(A) + length · shadow of A.
TEST_F(Hulls, OfASphereAndItsTranslateIsTheSweptSphere) {
  const int n = 48;
  const double pi = std::numbers::pi;
  const double shadow = 0.5 * n * std::sin(2 * pi / n);
  const double widest = std::sin(pi * (n / 4 + 0.5) / (n / 2));
  const double sphere = run_volume({b.sphere(1, n)});
  const double volume = run_volume({b.node(
      Hull{}, {b.sphere(1, n), b.translate({0, 0, 7}, {b.sphere(1, n)})})});
  EXPECT_NEAR(volume, sphere + 7 * shadow * widest * widest, kHullRounding);
}

// However rounding orders the leaves, as along a Bézier curve whose control
// points lie in a row.
TEST_F(Hulls, OfARowOfEqualLeavesIsThatOfItsEnds) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int trial = 0; trial < 60; ++trial) {
    SCOPED_TRACE(trial);
    Vec3 along(number(random), number(random), number(random));
    if (trial % 4 < 3)
      along = Vec3(trial % 4 == 0, trial % 4 == 1, trial % 4 == 2);
    const Vec3 start(number(random), number(random), number(random));
    const Vec3 middle = start + 5.0 * along;
    const Vec3 end = start + 10.0 * along;
    std::vector<const Node*> row;
    for (int i = 0; i <= 20; ++i) {
      const double t = i / 20.0;
      row.push_back(b.translate(
          (1 - t) * (1 - t) * start + 2 * t * (1 - t) * middle + t * t * end,
          {b.sphere(1, 16)}));
    }
    const std::vector<const Node*> ends = {row.front(), row.back()};
    EXPECT_NEAR(run_volume({b.node(Hull{}, row)}),
                run_volume({b.node(Hull{}, ends)}), kHullRounding);
  }
}

TEST_F(Hulls, NestGroupAndMoveAsOne) {
  const auto pair = [&] {
    return TreeBuilder::Children{b.cube({1, 2, 3}),
                                 b.translate({4, 5, 6}, {b.sphere(2, 12)})};
  };
  const double plain = run_volume({b.node(Hull{}, pair())});
  const double nested = run_volume(
      {b.node(Hull{}, {b.node(Hull{}, pair()), b.node(Union{}, pair())})});
  EXPECT_NEAR(nested, plain, kHullRounding);
  const double scaled =
      run_volume({b.scale({2, -3, 0.5}, {b.node(Hull{}, pair())})});
  EXPECT_NEAR(scaled, -3 * plain, kHullRounding);  // mirrored
}

TEST_F(Hulls, OfThousandsOfEqualLeavesIsThatOfTheOutermost) {
  std::vector<const Node*> leaves;
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 20; ++j) {
      for (int k = 0; k < 20; ++k) {
        leaves.push_back(b.translate({i, j, k}, {b.cube({1, 1, 1})}));
      }
    }
  }
  EXPECT_NEAR(run_volume({b.node(Hull{}, leaves)}), 8000, kHullRounding);
}

// Points are given as faces of a polyhedron, whatever faces: BOSL2 does so.
TEST_F(Hulls, TakeTheCornersOfAnyHeapOfFaces) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back(i & 1, 2 * (i >> 1 & 1), 3 * (i >> 2));
  }
  corners.emplace_back(99, 99, 99);  // of no face
  const Node* heap =
      b.polyhedron(corners, {{0, 1, 2, 3, 4}, {5, 6}, {7}, {7, 7, 0}});
  const Node* moved = b.translate({1, 2, 3}, {b.node(Group{}, {heap})});
  EXPECT_NEAR(run_volume({b.node(Hull{}, {moved})}), 6, kHullRounding);
  EXPECT_TRUE(messages().empty());
  // In a union it is a solid, and there the faces matter.
  const Node* united = b.node(Union{}, {heap, b.cube({1, 2, 3})});
  EXPECT_NEAR(run_volume({b.node(Hull{}, {united})}), 6, kHullRounding);
  EXPECT_FALSE(messages().empty());
}

TEST_F(Hulls, OfNothingAreNothing) {
  EXPECT_TRUE(run({b.node(Hull{})}).is_empty());
  EXPECT_TRUE(run({b.node(Hull{}, {b.cube({0, 1, 1})})}).is_empty());
  Node* background = b.cube({1, 1, 1});
  background->is_background = true;
  EXPECT_TRUE(run({b.node(Hull{}, {background})}).is_empty());
}

// What is cut off a cube's corner is flat: the hull is the rest itself.
TEST_F(Hulls, OfADifferenceTakeTheCornersOfTheResult) {
  const Node* corner = b.translate({2, 2, 2}, {b.node(Sphere{2, {4}})});
  const Node* rest = b.node(Difference{}, {b.cube({2, 2, 2}), corner});
  const double volume = run_volume({b.node(Hull{}, {rest})});
  EXPECT_LT(volume, 8);
  // A notch does not show.
  const Node* notch = b.translate({0.5, 0.5, 0.5}, {b.cube({1, 1, 5})});
  const Node* notched = b.node(Difference{}, {b.cube({2, 2, 2}), notch});
  EXPECT_NEAR(run_volume({b.node(Hull{}, {notched})}), 8, kHullRounding);
  // Half of a cube, and a leaf beside it.
  const Node* half =
      b.node(Intersection{},
             {b.cube({2, 2, 2}), b.translate({0, 0, 1}, {b.cube({3, 3, 3})})});
  EXPECT_NEAR(run_volume({b.node(Hull{}, {half})}), 4, kHullRounding);
  const Node* beside = b.translate({4, 0, 1}, {b.cube({1, 2, 1})});
  EXPECT_NEAR(run_volume({b.node(Hull{}, {half, beside})}), 10, kHullRounding);
}

// Faces inside of what is known of the hull are passed over.
TEST_F(Hulls, OfADifferenceMissNoFaceOfTheResult) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(0, 4);
  const auto place = [&](const Node* node) {
    const double x = number(random);
    const double y = number(random);
    return b.translate({x, y, number(random)}, {node});
  };
  for (int round = 0; round < 20; ++round) {
    SCOPED_TRACE(round);
    std::vector<const Node*> solids;
    for (int i = 0; i < 12; ++i) solids.push_back(place(b.sphere(2, 8)));
    std::vector<const Node*> operands{b.node(Union{}, solids)};
    for (int i = 0; i < 3; ++i) operands.push_back(place(b.cube({3, 3, 3})));
    const Node* rest = b.node(Difference{}, operands);

    std::vector<Vec3> corners;
    for (const BoundaryFace& face : boundary_faces(run_solid({rest}))) {
      for (const auto& contour : face.contours) {
        corners.insert(corners.end(), contour.begin(), contour.end());
      }
    }
    EXPECT_NEAR(run_volume({b.node(Hull{}, {rest})}),
                signed_volume(convex_hull(corners)), 1e-6);
  }
}

TEST_F(Hulls, OfABooleanOfNothingAreNothing) {
  const Node* nothing =
      b.node(Difference{}, {b.cube({1, 1, 1}), b.cube({1, 1, 1})});
  EXPECT_TRUE(run({b.node(Hull{}, {nothing})}).is_empty());
}

// Base and top of a frustum, of no volume of their own.
TEST_F(Hulls, TakeTheCornersOfFlattenedSolids) {
  const Node* base = b.scale({1, 1, 0}, {b.cube({3, 3, 1})});
  const Node* top =
      b.translate({1, 1, 6}, {b.scale({1, 1, 0}, {b.cube({1, 1, 1})})});
  EXPECT_NEAR(run_volume({b.node(Hull{}, {base, b.node(Group{}, {top})})}),
              6.0 / 3 * (9 + 3 + 1), kHullRounding);
  const Node* tip =
      b.translate({1, 1, 6}, {b.scale(Vec3(0), {b.sphere(1, 8)})});
  EXPECT_NEAR(run_volume({b.node(Hull{}, {base, tip})}), 6.0 / 3 * 9,
              kHullRounding);
}

// Points come as faces of less than three corners.
TEST_F(Hulls, TakeThePointsOfAPolyhedron) {
  EXPECT_NEAR(
      run_volume({b.node(
          Hull{}, {b.polyhedron({{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, {0, 0, 6}},
                                {{0}, {1, 2}, {3}})})}),
      36, kHullRounding);
  const Node* tip = b.polyhedron({{1, 1, 7}}, {{0}});
  EXPECT_NEAR(run_volume({b.node(Hull{}, {b.cube({3, 3, 1}), tip})}),
              9 + 6.0 / 3 * 9, kHullRounding);
  EXPECT_NEAR(run_volume({b.cube({3, 3, 1}), tip}), 9, kHullRounding);
}

TEST_F(Hulls, InThePlaneTakeAllOutlines) {
  const plane::Region region = run_flat(
      {b.node(Hull{}, {b.node(Square{{1, 1}}),
                       b.translate({3, 3, 0}, {b.node(Square{{1, 1}})})})});
  ASSERT_EQ(region.contours.size(), 1u);
  EXPECT_EQ(region.contours[0].size(), 6u);
  EXPECT_DOUBLE_EQ(plane::area(region), 7);
}

TEST_F(Hulls, LeaveOutChildrenOfTheOtherDimension) {
  EXPECT_NEAR(
      run_volume({b.node(Hull{}, {b.cube({1, 1, 1}), b.node(Square{{5, 5}})})}),
      1, kHullRounding);
  EXPECT_EQ(messages(), (std::vector<std::string>{
                            "Mixing 2D and 3D objects is not supported",
                            "Ignoring 2D child object for 3D operation"}));
}

}  // namespace
}  // namespace lamina::csg
