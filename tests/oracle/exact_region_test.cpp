#include "tests/oracle/exact_region.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/oracle/test_meshes.h"
#include "tests/support/contour_checks.h"

namespace lamina::oracle {
namespace {

using plane::Contours;

using Loop = std::vector<Vec2>;

Loop square(double x, double y, double side) {
  return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
}

Loop reversed(const Loop& loop) { return {loop.rbegin(), loop.rend()}; }

Contours contours_of(const std::vector<Loop>& loops) {
  Contours contours;
  for (const Loop& loop : loops) support::add_loop(contours, loop);
  return contours;
}

ExactRegion region_of(const std::vector<Loop>& loops) {
  return region_of_loops(contours_of(loops));
}

TEST(CountRegions, OfNothingIsNothing) {
  EXPECT_EQ(count_regions(ExactRegion()), (RegionCounts{0, 0}));
}

TEST(CountRegions, SeparatesSquaresThatTouchAtACorner) {
  EXPECT_EQ(count_regions(region_of({square(0, 0, 1), square(1, 1, 1)})),
            (RegionCounts{2, 0}));
}

TEST(CountRegions, JoinsSquaresThatShareAnEdge) {
  EXPECT_EQ(count_regions(region_of({square(0, 0, 1), square(1, 0.5, 1)})),
            (RegionCounts{1, 0}));
}

TEST(CountRegions, SeparatesHolesThatTouchAtACorner) {
  EXPECT_EQ(count_regions(region_of({square(0, 0, 9), reversed(square(1, 1, 1)),
                                     reversed(square(2, 2, 1))})),
            (RegionCounts{1, 2}));
}

TEST(CountRegions, CountsAHoleThatTouchesTheOuterLoopInAPoint) {
  const Loop hole = {{0, 2}, {1, 3}, {1, 1}};
  EXPECT_EQ(count_regions(region_of({square(0, 0, 4), hole})),
            (RegionCounts{1, 1}));
}

TEST(CountRegions, CountsIslandsInHoles) {
  EXPECT_EQ(
      count_regions(region_of({square(0, 0, 9), reversed(square(1, 1, 7)),
                               square(2, 2, 5), reversed(square(3, 3, 3))})),
      (RegionCounts{2, 2}));
}

TEST(ExactArea, OfATurnedSquareIsExact) {
  EXPECT_EQ(exact_area(region_of({{{0, 0}, {3, 1}, {2, 4}, {-1, 3}}})), "10");
  EXPECT_EQ(exact_area(region_of({{{0, 0}, {1, 0}, {0, 0.5}}})), "1/4");
}

TEST(ExactSection, OfATetrahedronScalesWithTheSquareOfTheDistance) {
  csg::Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  EXPECT_EQ(exact_area(exact_section(mesh, 1, 0)), "2");
  EXPECT_EQ(exact_area(exact_section(mesh, 0, 0)), "9/2");
  EXPECT_EQ(exact_area(exact_section(mesh, 3, 0)), "0");
  EXPECT_EQ(exact_area(exact_section(mesh, -1, 0)), "0");
}

TEST(ExactSection, OfAMirroredLeafIsTheSame) {
  csg::Mesh mesh = box({0, 0, 0}, {1, 2, 3});
  for (Vec3& vertex : mesh.vertices) vertex.x = -vertex.x;
  const auto scene = scene_of(plane::BooleanOp::kUnion, {mesh});
  EXPECT_EQ(exact_area(exact_section(scene, 1.5)), "2");
}

TEST(ExactSection, RefusesALeafThatIsNotClosed) {
  csg::Mesh mesh = box({0, 0, 0}, {1, 1, 1});
  mesh.triangles.pop_back();
  const auto scene = scene_of(plane::BooleanOp::kUnion, {mesh});
  EXPECT_THROW(exact_section(scene, 0.3), std::runtime_error);
}

TEST(ExactSection, JoinsOpenEndsWithinTheGap) {
  // Two boxes' worth of triangles whose corners do not quite agree.
  csg::Mesh mesh = box({0, 0, 0}, {1, 1, 1});
  for (auto& triangle : mesh.triangles) {
    for (auto& corner : triangle) {
      mesh.vertices.push_back(mesh.vertices[corner]);
      corner = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
      mesh.vertices.back().x += 1e-6 * std::sin(corner);
    }
  }
  EXPECT_THROW(exact_section(mesh, 0.3, 1e-8), std::runtime_error);
  const auto region = exact_section(mesh, 0.3, 1e-5);
  EXPECT_EQ(count_regions(settle(region, 1e-5)), (RegionCounts{1, 0}));
  EXPECT_LT(compare(region, contours_of({square(0, 0, 1)})).difference_area,
            1e-5);
}

TEST(ExactSection, EvaluatesEachOperator) {
  const auto a = box({0, 0, 0}, {4, 4, 1});
  const auto b = box({1, 1, -1}, {2, 2, 2});
  const auto c = box({3, 3, -1}, {5, 5, 2});
  using plane::BooleanOp;
  EXPECT_EQ(
      exact_area(exact_section(scene_of(BooleanOp::kUnion, {a, b, c}), 0.5)),
      "19");
  EXPECT_EQ(exact_area(exact_section(
                scene_of(BooleanOp::kDifference, {a, b, c}), 0.5)),
            "14");
  EXPECT_EQ(exact_area(
                exact_section(scene_of(BooleanOp::kIntersection, {a, c}), 0.5)),
            "1");
  EXPECT_EQ(count_regions(exact_section(
                scene_of(BooleanOp::kDifference, {a, b, c}), 0.5)),
            (RegionCounts{1, 1}));
}

TEST(ExactSection, LeavesNoSkinWhereCoplanarFacesCancel) {
  const auto a = box({0, 0, 0}, {4, 4, 1});
  const auto b = box({0, 1, 0}, {4, 2, 1});
  const auto region =
      exact_section(scene_of(plane::BooleanOp::kDifference, {a, b}), 0.5);
  EXPECT_EQ(count_regions(region), (RegionCounts{2, 0}));
  EXPECT_EQ(exact_area(region), "12");
}

TEST(EvaluateProgram, DescendsNestedOperators) {
  // difference(intersection(0, 1), union(2, difference(3, 4)))
  using plane::BooleanOp;
  WorldScene scene;
  scene.program = {{BooleanOp::kDifference, 0, false, 2},
                   {BooleanOp::kIntersection, 0, true, 2},
                   {BooleanOp::kUnion, 0, false, 2},
                   {BooleanOp::kDifference, 2, false, 2}};
  scene.parent = {1, 1, 2, 3, 3};
  scene.is_minuend = {false, false, false, true, false};
  for (unsigned bits = 0; bits < 32; ++bits) {
    std::vector<int> winding;
    std::vector<bool> in;
    for (unsigned i = 0; i < 5; ++i) {
      in.push_back(((bits >> i) & 1) != 0);
      winding.push_back(in.back() ? (i == 2 ? -1 : 2) : 0);
    }
    const bool expected = (in[0] && in[1]) && !(in[2] || (in[3] && !in[4]));
    EXPECT_EQ(evaluate_program(scene, winding), expected) << bits;
  }
}

TEST(EvaluateProgram, IsFalseForAnEmptyScene) {
  WorldScene scene;
  scene.program = {{plane::BooleanOp::kUnion, 0, false, 0}};
  EXPECT_FALSE(evaluate_program(scene, {}));
}

TEST(GenericHeights, KeepAwayFromVertices) {
  auto scene = scene_of(plane::BooleanOp::kUnion, {box({0, 0, 0}, {1, 1, 1})});
  for (int i = 1; i < 50; ++i) {
    scene.meshes.push_back(box({0, 0, 0}, {1, 1, i / 50.0}));
  }
  const auto heights = generic_heights(scene, 0, 1, 10);
  ASSERT_EQ(heights.size(), 10U);
  EXPECT_TRUE(std::is_sorted(heights.begin(), heights.end()));
  for (const double z : heights) {
    EXPECT_GT(std::abs(z * 50 - std::round(z * 50)), 1e-4);
  }
}

TEST(Compare, FindsNothingBetweenEquals) {
  const std::vector<Loop> loops = {square(0, 0, 9), reversed(square(1, 1, 7)),
                                   square(2, 2, 5)};
  const auto result = compare(region_of(loops), contours_of(loops));
  EXPECT_EQ(result.difference_area, 0);
  EXPECT_EQ(result.overlap_area, 0);
  EXPECT_EQ(result.actual_counts, (RegionCounts{2, 1}));
  EXPECT_EQ(result.expected_counts, result.actual_counts);
  EXPECT_DOUBLE_EQ(result.expected_area, 81 - 49 + 25);
  EXPECT_DOUBLE_EQ(result.actual_area, 81 - 49 + 25);
  EXPECT_DOUBLE_EQ(result.expected_perimeter, 4 * (9 + 7 + 5));
}

TEST(Compare, FindsAMissingHole) {
  const auto result =
      compare(region_of({square(0, 0, 9), reversed(square(1, 1, 0.5))}),
              contours_of({square(0, 0, 9)}));
  EXPECT_EQ(result.expected_counts, (RegionCounts{1, 1}));
  EXPECT_EQ(result.actual_counts, (RegionCounts{1, 0}));
  EXPECT_DOUBLE_EQ(result.difference_area, 0.25);
  EXPECT_NEAR(result.worst_place.x, 1.25, 0.26);
}

TEST(Compare, MeasuresAShiftedEdge) {
  const Loop moved = {{0, 0}, {9 + 1e-6, 0}, {9 + 1e-6, 9}, {0, 9}};
  const auto result =
      compare(region_of({square(0, 0, 9)}), contours_of({moved}));
  EXPECT_NEAR(result.difference_area, 9e-6, 1e-13);
}

TEST(Compare, MeasuresShiftsBelowTheRoundingOfAreas) {
  const Loop moved = {{0, 0}, {9, 0}, {9, std::nextafter(9, 10)}, {0, 9}};
  const auto result =
      compare(region_of({square(0, 0, 9)}), contours_of({moved}));
  EXPECT_GT(result.difference_area, 1e-16);
  EXPECT_LT(result.difference_area, 1e-13);
}

TEST(Compare, TellsRegionsMergedAtACorner) {
  const auto expected = region_of({square(0, 0, 1), square(1, 1, 1)});
  const Loop merged = {{0, 0}, {1, 0}, {1 + 1e-4, 1}, {2, 1},
                       {2, 2}, {1, 2}, {1, 1 + 1e-4}, {0, 1}};
  EXPECT_EQ(compare(expected, contours_of({merged})).actual_counts,
            (RegionCounts{1, 0}));
}

TEST(Compare, FindsLoopsThatOverlapOrRunTheWrongWay) {
  const auto expected = region_of({square(0, 0, 4)});
  EXPECT_DOUBLE_EQ(
      compare(expected, contours_of({square(0, 0, 4), square(1, 1, 1)}))
          .overlap_area,
      1);
  EXPECT_DOUBLE_EQ(
      compare(expected, contours_of({reversed(square(0, 0, 4))})).overlap_area,
      16);
}

TEST(Compare, AgreesWithARoundedTurnedSection) {
  csg::Mesh mesh = box({0, 0, 0}, {3, 2, 1});
  turn(mesh, 0.7);
  const auto scene = scene_of(plane::BooleanOp::kUnion, {mesh});
  Contours contours;
  const auto& v = mesh.vertices;
  support::add_loop(contours, {v[0], v[1], v[3], v[2]});
  const auto result = compare(exact_section(scene, 0.3), contours);
  EXPECT_EQ(result.actual_counts, (RegionCounts{1, 0}));
  EXPECT_LT(result.difference_area, 1e-14);
}

// The slit between two turned boxes is as thin as the rounding of their
// corners, and either reading of it is right.
TEST(Settle, ClosesSlitsOfRounding) {
  csg::Mesh a = box({0, 0, 0}, {1, 1, 1});
  csg::Mesh b = box({1, 0, 0}, {2, 1, 1});
  turn(a, 0.7);
  turn(b, 0.7);
  for (Vec3& vertex : b.vertices) vertex.x += 1e-15;
  const auto region =
      exact_section(scene_of(plane::BooleanOp::kUnion, {a, b}), 0.5);
  EXPECT_EQ(count_regions(settle(region, 2e-8)), (RegionCounts{1, 0}));
}

TEST(Settle, KeepsGapsAndWallsThatAreWide) {
  const auto region =
      region_of({square(0, 0, 1),
                 square(1 + 1e-6, 0, 1),
                 {{0, 2}, {2, 2}, {2, 2 + 1e-6}, {0, 2 + 1e-6}}});
  EXPECT_EQ(count_regions(settle(region, 2e-8)), (RegionCounts{3, 0}));
}

TEST(Settle, DropsWallsOfRounding) {
  const auto region =
      region_of({square(0, 0, 1), {{0, 2}, {2, 2}, {2, 2 + 1e-9}}});
  EXPECT_EQ(count_regions(settle(region, 2e-8)), (RegionCounts{1, 0}));
}

TEST(Settle, KeepsCornersApartThatTouch) {
  for (const double overlap : {-1e-12, 0.0, 1e-12}) {
    const double corner = 1 - overlap;
    const auto region = region_of({square(0, 0, 1), square(corner, corner, 1)});
    EXPECT_EQ(count_regions(settle(region, 2e-8)), (RegionCounts{2, 0}));
  }
}

}  // namespace
}  // namespace lamina::oracle
