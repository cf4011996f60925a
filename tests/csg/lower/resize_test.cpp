// resize(): the new box, as OpenSCAD 2021.01 has it (tried there, one by one).

#include <array>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include "csg/boundary/boundary_faces.h"
#include "tests/csg/lower/lower_fixture.h"

namespace lamina::csg {
namespace {

class Resizes : public LowerFixture {
 protected:
  Box3 resize(Vec3 size, std::array<bool, 3> automatic,
              const TreeBuilder::Children& children) {
    const Scene scene = run_solid({b.node(Resize{size, automatic}, children)});
    Box3 box;
    for (const BoundaryFace& face : boundary_faces(scene)) {
      for (const auto& contour : face.contours) {
        for (const Vec3 point : contour) {
          box.low = glm::min(box.low, point);
          box.high = glm::max(box.high, point);
        }
      }
    }
    return box;
  }
  void expect_box(const Box3& box, Vec3 low, Vec3 high) {
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(box.low[i], low[i], kRounding);
      EXPECT_NEAR(box.high[i], high[i], kRounding);
    }
  }

  static constexpr std::array<bool, 3> kNone{false, false, false};
  static constexpr std::array<bool, 3> kAll{true, true, true};
};

TEST_F(Resizes, KeepDirectionsWithoutSize) {
  expect_box(resize({10, 0, 0}, kNone, {b.cube({1, 2, 3})}), Vec3(0),
             {10, 2, 3});
  expect_box(resize({0, 0, 0}, kAll, {b.cube({1, 2, 3})}), Vec3(0), {1, 2, 3});
}

TEST_F(Resizes, ScaleAutomaticDirectionsAsTheGreatestSize) {
  expect_box(resize({10, 0, 0}, kAll, {b.cube({1, 2, 3})}), Vec3(0),
             {10, 20, 30});
  expect_box(resize({10, 20, 0}, {false, true, true}, {b.cube({1, 2, 3})}),
             Vec3(0), {10, 20, 30});
}

TEST_F(Resizes, ScaleAboutTheOrigin) {
  expect_box(
      resize({2, 4, 6}, kNone, {b.translate({1, 1, 1}, {b.cube({1, 1, 1})})}),
      {2, 4, 6}, {4, 8, 12});
}

TEST_F(Resizes, OfABooleanFitWhatIsLeft) {
  const Node* half = b.node(
      Difference{},
      {b.cube({1, 2, 3}), b.translate({0.5, -1, -1}, {b.cube({9, 9, 9})})});
  expect_box(resize({10, 5, 3}, kNone, {half}), Vec3(0), {10, 5, 3});
  // The leaves' boxes overlap more than the leaves do.
  const Node* lens =
      b.node(Intersection{},
             {b.sphere(5, 64), b.translate({6, 0, 0}, {b.sphere(5, 64)})});
  const Box3 box = resize({4, 8, 8}, kNone, {lens});
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(box.high[i] - box.low[i], i == 0 ? 4 : 8, kRounding);
  }
}

TEST_F(Resizes, WithNegativeSizesMirrorABooleanOnly) {
  expect_box(resize({-10, 0, 0}, kNone, {b.cube({1, 2, 3})}), Vec3(0),
             {1, 2, 3});
  const Node* half = b.node(
      Difference{},
      {b.cube({1, 2, 3}), b.translate({0.5, -1, -1}, {b.cube({9, 9, 9})})});
  expect_box(resize({-10, 5, 3}, kNone, {half}), {-10, 0, 0}, {0, 5, 3});
}

TEST_F(Resizes, OfAUnionKeepItsParts) {
  const TreeBuilder::Children parts{
      b.cube({1, 1, 1}), b.translate({5, 0, 0}, {b.cube({1, 1, 1})})};
  expect_box(resize({5, 5, 5}, kAll, parts), Vec3(0), {5, 5, 5});
  EXPECT_EQ(
      run_solid({b.node(Resize{{5, 5, 5}, kAll}, parts)}).instances.size(), 2u);
}

TEST_F(Resizes, InThePlaneScaleTheOutline) {
  const auto size = [&](Vec3 new_size) {
    const plane::Region region =
        run_flat({b.node(Resize{new_size, kAll}, {b.node(Square{{1, 2}})})});
    return region.contours.at(0).at(2);
  };
  EXPECT_EQ(size({10, 0, 0}), Vec2(10, 20));
  EXPECT_EQ(size({0, 6, 9}), Vec2(3, 6));
  EXPECT_EQ(size({10, -6, 9}), Vec2(10, 20));
}

TEST_F(Resizes, OfNothingAreNothing) {
  EXPECT_TRUE(run({b.node(Resize{{5, 5, 5}, kAll})}).is_empty());
  EXPECT_TRUE(
      run({b.node(Resize{{5, 5, 5}, kAll}, {b.cube({0, 0, 0})})}).is_empty());
  EXPECT_TRUE(messages().empty());
}

// What is resized is lowered twice, to be as fine as it has to be. Of resizes
// within each other that must not be twice for each.
TEST_F(Resizes, WithinEachOtherAreLoweredTwiceInAll) {
  const Node* node = b.sphere(1, 0);
  for (int i = 0; i < 100; ++i) {
    node = b.node(Resize{Vec3(i % 2 == 0 ? 20 : 2), kNone}, {node});
  }
  const Node* strange = b.polyhedron({{0, 0, 0}}, {{5}});
  LowerOptions options;
  options.chordal_error = 0.01;
  const Tree tree = b.tree({b.node(Resize{Vec3(20), kNone}, {node, strange})});
  const Lowered lowered = lower(tree, options, diagnostics);
  ASSERT_NE(lowered.scene(), nullptr);
  Diagnostics once;
  lower(tree, {}, once);
  EXPECT_EQ(diagnostics.all().size(), once.all().size());
  EXPECT_FALSE(messages().empty());
  // As fine as the ball of that size.
  const Tree ball = b.tree({b.sphere(10, 0)});
  const Lowered expected = lower(ball, options, diagnostics);
  const auto count = [](const Lowered& l) {
    return static_cast<double>(
        explicit_mesh(l.scene()->leaves.at(0)).vertices.size());
  };
  EXPECT_GE(count(lowered), count(expected));
}

// With a chordal error of 2 mm no corner of the circle's 5 sides is at its left
// end, and nothing is left of an offset or a cut.
TEST_F(Resizes, FindWhatCoarseFacetsHide) {
  const Node* strip =
      b.node(Intersection{},
             {b.node(Circle{10}),
              b.translate({-10, -10, 0}, {b.node(Square{{0.5, 20}})})});
  const Node* dot = b.node(Offset{-9.9, true}, {b.node(Circle{10})});
  const Node* cap =
      b.node(Projection{true}, {b.translate({0, 0, -9.9}, {b.sphere(10, 0)})});
  LowerOptions options;
  options.chordal_error = 2;
  for (const Node* hidden : {strip, dot, cap}) {
    for (const bool is_within : {false, true}) {
      const Node* node = b.node(Resize{{40, 40, 0}, kNone}, {hidden});
      // Beside what is not hidden, in a greater resize() that keeps the size.
      if (is_within) {
        node =
            b.node(Resize{{0, 0, 0}, kNone},
                   {node, b.translate({100, 0, 0}, {b.node(Square{{1, 1}})})});
      }
      const Lowered lowered = lower(b.tree({node}), options, diagnostics);
      const plane::Region* region = lowered.outline();
      ASSERT_NE(region, nullptr);
      ASSERT_EQ(region->contours.size(), is_within ? 2U : 1U);
      Box2 box;
      box.add(region->contours[0]);
      if (is_within && box.low.x > 90) {
        box = Box2();
        box.add(region->contours[1]);
      }
      EXPECT_NEAR(box.size().x, 40, 1e-6);
      EXPECT_NEAR(box.size().y, 40, 1e-6);
    }
  }
  EXPECT_TRUE(messages().empty());
}

TEST_F(Resizes, SayWhereFacetsHideWhatKeepsItsSize) {
  LowerOptions options;
  options.chordal_error = 2;
  const Tree tree =
      b.tree({b.node(Resize{{0, 0, 0}, kNone},
                     {b.node(Offset{-9.9, true}, {b.node(Circle{10})})})});
  EXPECT_TRUE(lower(tree, options, diagnostics).is_empty());
  EXPECT_EQ(messages(),
            std::vector<std::string>{
                "The size of what resize() scales changes with its facets, "
                "which may be farther off than asked for"});
}

TEST_F(Resizes, OfBooleansThatAreEmptySayNothing) {
  LowerOptions options;
  for (const double error : {2.0, 0.1, 0.01}) {
    options.chordal_error = error;
    const Tree tree = b.tree(
        {b.node(Resize{Vec3(10), kNone},
                {b.node(Intersection{},
                        {b.sphere(1, 0),
                         b.translate({1.5, 1.5, 0}, {b.sphere(1, 0)})})}),
         b.node(Resize{Vec3(10), kNone},
                {b.node(Resize{Vec3(5), kNone},
                        {b.node(Difference{},
                                {b.cube({1, 1, 1}), b.cube({2, 2, 2})})}),
                 b.cube({1, 1, 1})})});
    EXPECT_FALSE(lower(tree, options, diagnostics).is_empty());
  }
  EXPECT_EQ(messages(), std::vector<std::string>());
}

}  // namespace
}  // namespace lamina::csg
