#include <limits>

#include <gtest/gtest.h>
#include <pthread.h>

#include "tests/csg/lower/lower_fixture.h"

namespace lamina::csg {
namespace {

class LowerTest : public LowerFixture {};

TEST_F(LowerTest, EqualPrimitivesShareALeafWhateverTheirSize) {
  const Scene scene = run_solid(
      {b.cube(Vec3(1)), b.cube({1, 2, 3}), b.sphere(1, 8), b.sphere(2, 8),
       b.cylinder(1, 2, 2, 8), b.cylinder(5, 3, 3, 8)});
  EXPECT_EQ(scene.leaves.size(), 3u);
  EXPECT_EQ(scene.instances.size(), 6u);
}

TEST_F(LowerTest, UnionsOfUnionsAreOneUnion) {
  const Scene scene = run_solid(
      {b.node(Union{}, {b.cube(Vec3(1)), b.node(Group{}, {b.sphere(1, 8)})}),
       b.node(Color{}, {b.cube(Vec3(2))})});
  ASSERT_EQ(scene.program.size(), 1u);
  EXPECT_EQ(scene.program[0].op, plane::BooleanOp::kUnion);
  EXPECT_EQ(scene.program[0].child_count, 3u);
}

TEST_F(LowerTest, TransformsArePushedToTheInstances) {
  const Scene scene = run_solid(
      {b.translate({1, 0, 0}, {b.scale({2, 2, 2}, {b.cube(Vec3(1))})})});
  EXPECT_EQ(scene.instances[0].box.low, Vec3(1, 0, 0));
  EXPECT_EQ(scene.instances[0].box.high, Vec3(3, 2, 2));
}

TEST_F(LowerTest, DifferenceNamesItsMinuend) {
  const Scene scene = run_solid({b.node(
      Difference{}, {b.cube(Vec3(4)), b.cube(Vec3(1)), b.cube(Vec3(2))})});
  ASSERT_EQ(scene.program.size(), 1u);
  EXPECT_EQ(scene.program[0].op, plane::BooleanOp::kDifference);
  EXPECT_TRUE(scene.instances[0].is_minuend);
  EXPECT_FALSE(scene.instances[1].is_minuend);
  EXPECT_EQ(scene.box.high, Vec3(4));
}

TEST_F(LowerTest, DifferenceWithoutMinuendIsEmpty) {
  EXPECT_TRUE(run({b.node(Difference{}, {b.node(Group{}), b.cube(Vec3(1))})})
                  .is_empty());
}

TEST_F(LowerTest, IntersectionWithAnEmptyOperandIsEmpty) {
  EXPECT_TRUE(run({b.node(Intersection{}, {b.cube(Vec3(1)), b.node(Group{})})})
                  .is_empty());
}

TEST_F(LowerTest, SubtrahendsOutOfReachAreDropped) {
  const Scene scene = run_solid(
      {b.node(Difference{},
              {b.cube(Vec3(1)), b.translate({1, 0, 0}, {b.cube(Vec3(1))})})});
  EXPECT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.program[0].op, plane::BooleanOp::kUnion);
}

TEST_F(LowerTest, IntersectionBoxIsTheOverlap) {
  const Scene scene = run_solid(
      {b.node(Intersection{},
              {b.cube(Vec3(4)), b.translate({1, 2, 3}, {b.cube(Vec3(5))})})});
  EXPECT_EQ(scene.box.low, Vec3(1, 2, 3));
  EXPECT_EQ(scene.box.high, Vec3(4));
}

TEST_F(LowerTest, RootModifierDropsEverythingAroundIt) {
  Node* chosen = b.cube(Vec3(1));
  chosen->is_root = true;
  const Scene scene =
      run_solid({b.sphere(1, 8), b.translate({9, 9, 9}, {chosen})});
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.instances[0].box.low, Vec3(0));
}

TEST_F(LowerTest, BackgroundIsIgnored) {
  Node* ghost = b.cube(Vec3(1));
  ghost->is_background = true;
  EXPECT_TRUE(run({ghost}).is_empty());
}

TEST_F(LowerTest, OperandsOutsideTheOverlapAreDropped) {
  const Scene scene = run_solid(
      {b.node(Intersection{},
              {b.node(Union{}, {b.cube(Vec3(4)),
                                b.translate({9, 0, 0}, {b.cube(Vec3(4))})}),
               b.sphere(3, 8)})});
  EXPECT_EQ(scene.instances.size(), 2u);
}

TEST_F(LowerTest, DisjointOperandsIntersectInNothing) {
  EXPECT_TRUE(
      run({b.node(Intersection{}, {b.cube(Vec3(1)),
                                   b.translate({1, 0, 0}, {b.cube(Vec3(1))})})})
          .is_empty());
}

TEST_F(LowerTest, DifferencesOfDifferencesAreOneDifference) {
  Node* inner = b.node(Difference{}, {b.cube(Vec3(4)), b.cube(Vec3(1))});
  const Scene scene =
      run_solid({b.node(Difference{}, {inner, b.cube(Vec3(2))})});
  ASSERT_EQ(scene.program.size(), 1u);
  EXPECT_EQ(scene.program[0].child_count, 3u);
  EXPECT_TRUE(scene.instances[0].is_minuend);
  EXPECT_FALSE(scene.instances[1].is_minuend);
  EXPECT_FALSE(scene.instances[2].is_minuend);
}

TEST_F(LowerTest, ADifferenceOnTheRightStaysItself) {
  Node* inner = b.node(Difference{}, {b.cube(Vec3(4)), b.cube(Vec3(1))});
  const Scene scene =
      run_solid({b.node(Difference{}, {b.cube(Vec3(2)), inner})});
  ASSERT_EQ(scene.program.size(), 2u);
  EXPECT_FALSE(scene.program[1].is_minuend);
}

TEST_F(LowerTest, ParentsStandBeforeTheirChildren) {
  Node* node = b.cube(Vec3(4));
  for (int i = 0; i < 10; ++i) {
    node = b.node(Difference{}, {b.cube(Vec3(5 + i)),
                                 b.node(Intersection{}, {node, b.sphere(9, 9)}),
                                 b.sphere(1, 5)});
  }
  const Scene scene = run_solid({node});
  std::vector<std::uint32_t> counts(scene.program.size(), 0);
  for (std::uint32_t i = 1; i < scene.program.size(); ++i) {
    EXPECT_LT(scene.program[i].parent, i);
    ++counts[scene.program[i].parent];
  }
  for (const Instance& instance : scene.instances) ++counts[instance.parent];
  for (std::uint32_t i = 0; i < scene.program.size(); ++i) {
    EXPECT_EQ(scene.program[i].child_count, counts[i]);
  }
}

TEST_F(LowerTest, NegativeVolumesAreMarkedByTheDeterminantAlone) {
  const Scene scene = run_solid({b.scale({-1, 1, 1}, {b.cube({1, 2, 3})})});
  EXPECT_EQ(scene.box.low, Vec3(-1, 0, 0));
  EXPECT_EQ(run_volume({b.scale({-1, 1, 1}, {b.cube({1, 2, 3})})}), -6);
}

TEST_F(LowerTest, InfiniteMatricesRemoveTheirObject) {
  Mat4 m(1.0);
  m[3][0] = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(run({b.transform(m, {b.cube(Vec3(1))})}).is_empty());
  EXPECT_EQ(messages(),
            (std::vector<std::string>{
                "Transformation matrix contains Not-a-Number and/or Infinity "
                "- removing object."}));
}

TEST_F(LowerTest, WorldFromDesignTurnsTheWholeScene) {
  Diagnostics none;
  const Affine z_up_from_x{Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, 1, 0),
                           Vec3(0)};
  const Lowered lowered = lower(b.tree({b.cube({1, 2, 3})}),
                                {.world_from_design = z_up_from_x}, none);
  EXPECT_EQ(lowered.scene()->box.high, Vec3(2, 3, 1));
}

TEST_F(LowerTest, BoxesAreThoseOfTheVertices) {
  Mat4 turn(1.0);
  turn[0] = {0.6, 0, -0.8, 0};
  turn[2] = {0.8, 0, 0.6, 0};
  const Scene scene = run_solid({b.transform(turn, {b.sphere(2, 9)})});
  const Mesh mesh = explicit_mesh(scene.leaves[0]);
  Box3 box;
  for (const Vec3& vertex : mesh.vertices) {
    const Vec3 p = scene.instances[0].world_from_leaf * Vec4(vertex, 1);
    box.low = glm::min(box.low, p);
    box.high = glm::max(box.high, p);
  }
  EXPECT_NEAR(glm::length(box.low - scene.box.low), 0, 1e-12);
  EXPECT_NEAR(glm::length(box.high - scene.box.high), 0, 1e-12);
}

// Without a typesetter.
const TextParams kText;

TEST_F(LowerTest, UnsupportedModulesEndTheRun) {
  EXPECT_THROW(run({b.node(Text{&kText})}), GeometryError);
}

TEST_F(LowerTest, WithoutOperandsNothingNeedsSupport) {
  EXPECT_TRUE(run({b.node(Minkowski{}), b.node(Hull{})}).is_empty());
  EXPECT_EQ(run_solid({b.node(Minkowski{}, {b.cube(Vec3(1))})}).box.high,
            Vec3(1));
}

TEST_F(LowerTest, WhatIsNotDrawnNeedNotBeSupported) {
  Node* ghost = b.node(Text{&kText});
  ghost->is_background = true;
  EXPECT_EQ(run_solid({b.cube(Vec3(1)), ghost}).instances.size(), 1u);
}

TEST_F(LowerTest, AMillionChildrenAreOneFlatUnion) {
  const TreeBuilder::Children children(1000000, b.cube(Vec3(1)));
  const Scene scene = run_solid({b.node(Union{}, children)});
  EXPECT_EQ(scene.instances.size(), children.size());
  EXPECT_EQ(scene.program.size(), 1u);
}

TEST_F(LowerTest, RefusesWhatReachesTooFar) {
  const auto cube = [&](double size) { return b.cube(Vec3(size)); };
  EXPECT_EQ(run_solid({cube(1e9)}).instances.size(), 1u);
  const std::vector<const Node*> faults = {
      cube(2e9),
      b.translate({0, -1e12, 0}, {cube(1)}),
      b.node(Hull{}, {cube(1), cube(2e9)}),
      b.node(Hull{}, {cube(1), cube(1e200)}),
      b.node(Hull{}, {b.node(Difference{},
                             {cube(4e9), b.scale({1, 1, 9}, {cube(3e9)})}),
                      cube(1)}),
      b.node(Minkowski{}, {cube(6e8), cube(6e8)}),
      b.node(Minkowski{},
             {b.sphere(1, 8), b.translate({2e9, 0, 0}, {cube(1)})}),
      b.node(Minkowski{},
             {b.node(Difference{}, {cube(4), b.scale({1, 1, 9}, {cube(3)})}),
              b.translate({2e9, 0, 0}, {cube(1)})})};
  for (const Node* fault : faults) {
    EXPECT_THROW(run({cube(1), fault}), GeometryError);
  }
}

TEST_F(LowerTest, CuttersMayBeAsLargeAsTheyLike) {
  const Node* huge = b.translate(Vec3(-1e12), {b.cube(Vec3(2e12))});
  EXPECT_EQ(run_solid({b.node(Intersection{}, {b.cube(Vec3(1)), huge})})
                .instances.size(),
            2u);
  EXPECT_EQ(run_solid({b.node(Difference{}, {b.cube(Vec3(1)), huge})})
                .instances.size(),
            2u);
}

// Runs on a stack as large as the program's own.
void* lower_on_large_stack(void* tree) {
  Diagnostics diagnostics;
  const Lowered lowered =
      lower(*static_cast<const Tree*>(tree), {}, diagnostics);
  EXPECT_EQ(lowered.scene()->instances.size(), 100001u);
  return nullptr;
}

TEST_F(LowerTest, AHundredThousandLevelsAreNotTooDeep) {
  Node* node = b.cube(Vec3(1));
  for (int i = 0; i < 100000; ++i) {
    node = b.node(Group{}, {b.node(Difference{}, {b.cube(Vec3(1)), node})});
  }
  Tree tree = b.tree({node});
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, std::size_t{1} << 30);
  pthread_t thread{};
  ASSERT_EQ(pthread_create(&thread, &attributes, lower_on_large_stack, &tree),
            0);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
}

}  // namespace
}  // namespace lamina::csg
