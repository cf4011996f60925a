#include <gtest/gtest.h>

#include "tests/csg/solid/lower_fixture.h"

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
  EXPECT_EQ(scene.program[0].op, BooleanOp::kUnion);
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
  EXPECT_EQ(scene.program[0].op, BooleanOp::kDifference);
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
  EXPECT_EQ(scene.program[0].op, BooleanOp::kUnion);
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

TEST_F(LowerTest, FlattenedSolidsVanishWithAWarning) {
  EXPECT_TRUE(run({b.scale({1, 1, 0}, {b.cube(Vec3(1))})}).is_empty());
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_EQ(diagnostics.all()[0].message,
            "Scaling a 3D object with 0 - removing object");
}

TEST_F(LowerTest, AMillionChildrenAreOneFlatUnion) {
  const TreeBuilder::Children children(1000000, b.cube(Vec3(1)));
  const Scene scene = run_solid({b.node(Union{}, children)});
  EXPECT_EQ(scene.instances.size(), children.size());
  EXPECT_EQ(scene.program.size(), 1u);
}

}  // namespace
}  // namespace lamina::csg
