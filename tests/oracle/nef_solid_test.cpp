#include "tests/oracle/nef_solid.h"

#include <gtest/gtest.h>

#include "csg/boundary/leaf_mesh.h"
#include "tests/oracle/exact_region.h"
#include "tests/oracle/test_meshes.h"

namespace lamina::oracle {
namespace {

TEST(NefBoundary, EnclosesTheVolumeOfTheFormula) {
  // 6·6·4 - 4·5·2 + 1·1·2
  for (const double angle : {0.0, 0.7}) {
    EXPECT_NEAR(csg::signed_volume(nef_boundary(nested_scene(angle))), 106,
                1e-12)
        << angle;
  }
}

TEST(NefBoundary, HasTheExactSections) {
  const WorldScene scene = nested_scene(0.7);
  const csg::Mesh boundary = nef_boundary(scene);
  for (const double z : {0.5, 1.5, 2.25, 3.5}) {
    const auto result =
        compare(exact_section(scene, z), exact_section(boundary, z, 1e-12));
    EXPECT_EQ(result.expected_counts, result.actual_counts) << z;
    EXPECT_LT(result.difference_area, 1e-12) << z;
  }
}

TEST(NefBoundary, OfNothingIsNothing) {
  const auto scene =
      scene_of(plane::BooleanOp::kIntersection,
               {box({0, 0, 0}, {1, 1, 1}), box({2, 0, 0}, {3, 1, 1})});
  EXPECT_TRUE(nef_boundary(scene).triangles.empty());
}

TEST(NefBoundary, RefusesALeafThatIsNotClosed) {
  csg::Mesh open = box({0, 0, 0}, {1, 1, 1});
  open.triangles.pop_back();
  EXPECT_THROW(nef_boundary(scene_of(plane::BooleanOp::kUnion, {open})),
               std::runtime_error);
}

}  // namespace
}  // namespace lamina::oracle
