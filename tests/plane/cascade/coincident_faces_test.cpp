// Coincident faces follow one rule, whatever axis they are square to: the
// solids that share one unite without a wall, a difference leaves no skin. So
// a scene and the same scene turned, its x, y and z exchanged, are solid in the
// same places, also next to its faces.

#include <cmath>
#include <cstdint>
#include <optional>
#include <random>

#include <gtest/gtest.h>

#include "csg/scene.h"
#include "ldni/section/grid.h"
#include "ldni/section/leaf_section.h"
#include "plane/cascade/kinetic_ray.h"
#include "tests/plane/cascade/section_reference.h"
#include "tests/support/contour_checks.h"
#include "tests/support/random_scenes.h"

namespace lamina::plane {
namespace {

using support::SceneStyle;

// (x, y, z) to (y, z, x), without rounding.
Affine next_axis() {
  Affine turn(0.0);
  turn[1].x = turn[2].y = turn[0].z = 1;
  return turn;
}

// Beside a plane of the grid on which leaves stand, along one axis or all.
Vec3 place_beside_faces(std::mt19937_64& random) {
  constexpr double kBeside = 1e-4;
  const auto share = [&] {
    return static_cast<double>(random() % 4096) / 4096;
  };
  Vec3 place(0);
  for (int axis = 0; axis < 3; ++axis) {
    place[axis] = 0.25 * std::round(16 * share() - 8);
    place[axis] += random() % 3 == 0 ? 0.25 * share()
                                     : (random() % 2 == 0 ? kBeside : -kBeside);
  }
  return place;
}

// Whether the section at the place's height is solid there; none where a face
// is too near to tell.
std::optional<bool> is_solid(const csg::Scene& scene, const Vec3& place) {
  constexpr double kDoubt = 1e-5;
  const ldni::LayerGrid grid = ldni::LayerGrid::at_heights({place.z});
  testing::SectionReference reference(scene);
  reference.cut(grid.section_z(0), grid.threshold(0));
  if (reference.distance(Vec2(place)) < kDoubt) return {};
  const ldni::LeafSectioner sectioner(scene, grid);
  ldni::SectionBlock block;
  sectioner.cut(0, 1, block);
  const BooleanProgram program = csg::program_of(scene);
  KineticRay ray(program);
  Contours contours;
  ray.sweep(block, 0, contours);
  EXPECT_TRUE(support::are_sound(contours));
  return support::contains(contours, Vec2(place));
}

class CoincidentFaces : public ::testing::TestWithParam<SceneStyle> {};

TEST_P(CoincidentFaces, AreTheSameInXAndYAndZ) {
  const Affine turn = next_axis();
  int solid = 0;
  int judged = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const csg::Scene upright =
        support::random_scene(seed, GetParam(), 2 + static_cast<int>(seed % 9));
    const csg::Scene turned = support::placed_scene(upright, turn);
    const csg::Scene turned_twice = support::placed_scene(turned, turn);
    std::mt19937_64 random(seed);
    for (int i = 0; i < 20; ++i) {
      const Vec3 place = place_beside_faces(random);
      const Vec3 next = turn * Vec4(place, 1);
      const auto in_z = is_solid(upright, place);
      const auto in_x = is_solid(turned, next);
      const auto in_y = is_solid(turned_twice, turn * Vec4(next, 1));
      if (!in_x || !in_y || !in_z) continue;
      ++judged;
      solid += *in_z ? 1 : 0;
      EXPECT_EQ(*in_x, *in_z) << "seed " << seed << ", place " << i;
      EXPECT_EQ(*in_y, *in_z) << "seed " << seed << ", place " << i;
    }
  }
  EXPECT_GT(judged, 1000);
  EXPECT_GT(solid, 50);
}

INSTANTIATE_TEST_SUITE_P(Styles, CoincidentFaces,
                         ::testing::Values(SceneStyle::kAligned,
                                           SceneStyle::kNoisy));

}  // namespace
}  // namespace lamina::plane
