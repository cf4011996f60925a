// Boundary faces, judged by the volume and the area that they enclose.

#include "csg/boundary/boundary_faces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/csg/lower/lower_fixture.h"

namespace lamina::csg {
namespace {

Vec3 area_vector(const BoundaryFace& face) {
  Vec3 sum(0);
  for (const auto& contour : face.contours) {
    for (std::size_t i = 0; i < contour.size(); ++i) {
      sum += 0.5 * glm::cross(contour[i] - contour[0],
                              contour[(i + 1) % contour.size()] - contour[0]);
    }
  }
  return sum;
}

// By the divergence theorem: sound only if the faces close.
double volume(const std::vector<BoundaryFace>& faces) {
  double sum = 0;
  for (const BoundaryFace& face : faces) {
    sum += glm::dot(area_vector(face), face.contours[0][0]) / 3;
  }
  return sum;
}

double area(const std::vector<BoundaryFace>& faces) {
  double sum = 0;
  for (const BoundaryFace& face : faces) sum += glm::length(area_vector(face));
  return sum;
}

// 0 where the faces close.
double gap(const std::vector<BoundaryFace>& faces) {
  Vec3 sum(0);
  for (const BoundaryFace& face : faces) sum += area_vector(face);
  return glm::length(sum);
}

class BoundaryFaces : public LowerFixture {
 protected:
  std::vector<BoundaryFace> faces(const TreeBuilder::Children& children) {
    const Lowered lowered = run(children);
    if (!lowered.scene()) return {};
    const auto result = boundary_faces(*lowered.scene());
    EXPECT_NEAR(gap(result), 0, kBooleanRounding);
    for (const BoundaryFace& face : result) {
      EXPECT_NEAR(glm::length(face.normal), 1, 1e-12);
      EXPECT_GT(glm::dot(face.normal, area_vector(face)), 0);
    }
    return result;
  }
  const Node* unite(const TreeBuilder::Children& c) {
    return b.node(Union{}, c);
  }
  const Node* subtract(const TreeBuilder::Children& c) {
    return b.node(Difference{}, c);
  }
  const Node* intersect(const TreeBuilder::Children& c) {
    return b.node(Intersection{}, c);
  }
};

TEST_F(BoundaryFaces, OfOneLeafAreItsFaces) {
  const auto result = faces({b.cube({2, 3, 4})});
  EXPECT_EQ(result.size(), 6u);
  EXPECT_DOUBLE_EQ(volume(result), 24);
  EXPECT_DOUBLE_EQ(area(result), 52);
}

TEST_F(BoundaryFaces, OfAMirroredLeafFaceOutwards) {
  const auto result = faces({b.scale({-2, 3, 4}, {b.sphere(1, 20)})});
  const auto plain = faces({b.scale({2, 3, 4}, {b.sphere(1, 20)})});
  EXPECT_NEAR(volume(result), volume(plain), 1e-9);
}

TEST_F(BoundaryFaces, OfAPipeHaveHoles) {
  const Node* ring = b.node(Difference{}, {b.node(Square{{4, 4}, true}),
                                           b.node(Square{{2, 2}, true})});
  LinearExtrudeParams params;
  params.height = 5;
  const auto result = faces({b.linear_extrude(params, {ring})});
  EXPECT_EQ(result.size(), 10u);
  EXPECT_DOUBLE_EQ(volume(result), 60);
  EXPECT_DOUBLE_EQ(area(result), 24 + 16 * 5 + 8 * 5);
}

TEST_F(BoundaryFaces, OfTwoCubesThatOverlap) {
  const TreeBuilder::Children both{b.cube({2, 2, 2}),
                                   b.translate({1, 1, 1}, {b.cube({2, 2, 2})})};
  const auto united = faces({unite(both)});
  EXPECT_NEAR(volume(united), 15, kBooleanRounding);
  EXPECT_NEAR(area(united), 42, kBooleanRounding);
  const auto common = faces({intersect(both)});
  EXPECT_NEAR(volume(common), 1, kBooleanRounding);
  EXPECT_NEAR(area(common), 6, kBooleanRounding);
  const auto rest = faces({subtract(both)});
  EXPECT_NEAR(volume(rest), 7, kBooleanRounding);
  EXPECT_NEAR(area(rest), 24, kBooleanRounding);
}

TEST_F(BoundaryFaces, OfACubeInsideAnother) {
  const TreeBuilder::Children both{b.cube({4, 4, 4}),
                                   b.translate({1, 1, 1}, {b.cube({1, 1, 1})})};
  EXPECT_EQ(faces({unite(both)}).size(), 6u);
  const auto hollow = faces({subtract(both)});
  EXPECT_EQ(hollow.size(), 12u);
  EXPECT_DOUBLE_EQ(volume(hollow), 63);
  EXPECT_DOUBLE_EQ(area(hollow), 102);
}

TEST_F(BoundaryFaces, ThatCoincideAreThereOnceOrNotAtAll) {
  // A wall that two cubes share is none; faces in one plane come once.
  const auto beside =
      faces({b.cube({1, 1, 1}), b.translate({1, 0, 0}, {b.cube({1, 1, 1})})});
  EXPECT_NEAR(volume(beside), 2, kBooleanRounding);
  EXPECT_NEAR(area(beside), 10, kBooleanRounding);
  const auto overlapping =
      faces({b.cube({2, 1, 1}), b.translate({1, 0, 0}, {b.cube({2, 1, 1})})});
  EXPECT_NEAR(volume(overlapping), 3, kBooleanRounding);
  EXPECT_NEAR(area(overlapping), 14, kBooleanRounding);
  const auto twice = faces({b.cube({2, 1, 1}), b.cube({2, 1, 1})});
  EXPECT_NEAR(volume(twice), 2, kBooleanRounding);
  EXPECT_NEAR(area(twice), 10, kBooleanRounding);
  // Nothing is left of a cube minus itself, and no skin of a flush cut.
  EXPECT_TRUE(
      faces({subtract({b.cube({1, 1, 1}), b.cube({1, 1, 1})})}).empty());
  const auto cut = faces({subtract(
      {b.cube({3, 1, 1}), b.translate({1, 0, 0}, {b.cube({1, 1, 1})})})});
  EXPECT_NEAR(volume(cut), 2, kBooleanRounding);
  EXPECT_NEAR(area(cut), 12, kBooleanRounding);
}

TEST_F(BoundaryFaces, OfAPolyhedronThatOverlapsItselfHideItsInside) {
  std::vector<Vec3> points;
  std::vector<std::vector<std::uint32_t>> sides;
  for (std::uint32_t k = 0; k < 2; ++k) {
    const double s = k;
    for (const double z : {0.0, 2.0}) {
      for (const Vec2 p : {Vec2(0, 0), Vec2(2, 0), Vec2(2, 2), Vec2(0, 2)}) {
        points.emplace_back(p.x + s, p.y + s, z + s);
      }
    }
    const std::uint32_t o = 8 * k;
    sides.push_back({o, o + 1, o + 2, o + 3});
    sides.push_back({o + 7, o + 6, o + 5, o + 4});
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t j = (i + 1) % 4;
      sides.push_back({o + i, o + 4 + i, o + 4 + j, o + j});
    }
  }
  const auto result = faces({b.polyhedron(points, sides)});
  EXPECT_NEAR(volume(result), 15, kBooleanRounding);
  EXPECT_NEAR(area(result), 42, kBooleanRounding);
}

// vol(A ∪ B) + vol(A ∩ B) = vol A + vol B, vol(A - B) = vol A - vol(A ∩ B), and
// areas likewise where no faces coincide, for solids in any position and for
// those that have most of their faces in common planes.
TEST_F(BoundaryFaces, ObeyTheLawsOfVolume) {
  std::mt19937 random(3);
  const auto number = [&](int n) { return static_cast<int>(random() % n); };
  const auto solid = [&]() -> const Node* {
    const Vec3 size(1 + number(3), 1 + number(3), 1 + number(3));
    const Vec3 shift(number(3), number(3), number(3));
    switch (number(4)) {
      case 0:
        return b.translate(shift,
                           {b.scale(size, {b.sphere(1, 3 + number(12))})});
      case 1:
        return b.translate(
            shift, {b.cylinder(size.z, size.x, number(2), 3 + number(12))});
      case 2:
        return b.translate(shift + Vec3(0.5, 0.25, 0.125), {b.cube(size)});
      default:
        return b.translate(shift, {b.cube(size)});
    }
  };
  for (int round = 0; round < 300; ++round) {
    SCOPED_TRACE(round);
    const Node* one = solid();
    const Node* two = unite({solid(), subtract({solid(), solid()})});
    const auto a = faces({one});
    const auto c = faces({two});
    const auto common = faces({intersect({one, two})});
    const auto all = faces({unite({one, two})});
    EXPECT_NEAR(volume(all) + volume(common), volume(a) + volume(c),
                kBooleanRounding);
    const auto rest = faces({subtract({one, two})});
    EXPECT_NEAR(volume(rest), volume(a) - volume(common), kBooleanRounding);
  }
}

// Faces that look both ways count by the side to which they look.
struct SideSums {
  double area = 0;
  Vec3 vector = Vec3(0);
  Box3 box;

  void add(const Vec3& normal, double part, const Box3& part_box) {
    area += part;
    vector += part * normal;
    box.add(part_box);
  }
};

// Scan lines find the areas and the boxes of what plane problems find, for
// solids that share planes and edges.
TEST_F(BoundaryFaces, AreMeasuredAsTheyAreSolved) {
  std::mt19937 random(5);
  const auto number = [&](int n) { return static_cast<int>(random() % n); };
  const auto solid = [&]() -> const Node* {
    const Vec3 size(1 + number(3), 1 + number(3), 1 + number(3));
    const Vec3 shift(number(3), number(3), number(3));
    if (number(2) == 0) return b.translate(shift, {b.cube(size)});
    return b.translate(shift,
                       {b.cylinder(size.z, size.x, number(2), 3 + number(12))});
  };
  int faces = 0;
  for (int round = 0; round < 300; ++round) {
    SCOPED_TRACE(round);
    const Lowered lowered = run({unite({solid(), solid()}),
                                 subtract({solid(), unite({solid(), solid()})}),
                                 intersect({solid(), solid()})});
    if (!lowered.scene()) continue;
    BoundaryFinder finder(*lowered.scene());
    const auto all = [](const Box3&) { return true; };
    for (const OpenFace& open :
         finder.take_settled(all, [](const BoundaryFace&) {})) {
      SideSums solved;
      finder.solve(open, [&](const BoundaryFace& face) {
        solved.add(face.normal, glm::dot(face.normal, area_vector(face)),
                   box_of(face));
      });
      SideSums measured;
      const MeasuredFace result = finder.measure(open, 10'000);
      EXPECT_TRUE(result.is_exact);
      for (const BoundaryPart& part : result.parts) {
        measured.add(part.normal, part.area, part.box);
      }
      ++faces;
      ASSERT_NEAR(measured.area, solved.area, kBooleanRounding);
      ASSERT_NEAR(glm::distance(measured.vector, solved.vector), 0,
                  kBooleanRounding);
      if (solved.area < kBooleanRounding) continue;
      EXPECT_NEAR(glm::distance(measured.box.low, solved.box.low), 0, 1e-5);
      EXPECT_NEAR(glm::distance(measured.box.high, solved.box.high), 0, 1e-5);
    }
  }
  EXPECT_GT(faces, 3000);
}

TEST_F(BoundaryFaces, MeasuredByFewLinesAreEstimates) {
  const Scene scene = run_solid(
      {subtract({b.cube({10, 10, 1}),
                 b.translate({5, 5, -1}, {b.cylinder(3, 4, 4, 200)})})});
  BoundaryFinder finder(scene);
  const auto open = finder.take_settled([](const Box3&) { return true; },
                                        [](const BoundaryFace&) {});
  double area = 0;
  bool is_exact = true;
  for (const OpenFace& face : open) {
    if (std::abs(face.normal.z) < 0.5) continue;
    const MeasuredFace measured = finder.measure(face, 100);
    is_exact = is_exact && measured.is_exact;
    for (const BoundaryPart& part : measured.parts) area += part.area;
  }
  EXPECT_FALSE(is_exact);
  const double disk = 100 * 16 * std::sin(2 * M_PI / 200);
  EXPECT_NEAR(area / (2 * (100 - disk)), 1, 0.01);
}

// Leaves that cross each other are not taken apart where another hides them.
TEST_F(BoundaryFaces, OfHiddenLeavesAreNotLookedAt) {
  TreeBuilder::Children balls;
  for (int i = 0; i < 8; ++i) {
    balls.push_back(b.translate({0.2 * i, 0, 0}, {b.sphere(1, 40)}));
  }
  balls.push_back(b.translate({-5, -5, -5}, {b.cube({10, 10, 10})}));
  const Scene scene = run_solid({unite(balls)});
  int boxes = 0;
  int taken = 0;
  visit_boundary_faces(
      scene,
      [&](const Box3&) {
        ++boxes;
        return true;
      },
      [&](const BoundaryFace&) { ++taken; });
  EXPECT_EQ(taken, 6);
  // Two of each ball: its own and that of its faces. A ball has 800 faces.
  EXPECT_LE(boxes, 50);
}

}  // namespace
}  // namespace lamina::csg
