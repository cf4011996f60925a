// Meshes that break every promise: triangles lost, turned or torn off, corners
// moved. Nobody can say where such a solid is; but what the ray makes of it are
// sound loops, and what was closed is counted.

#include <array>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "csg/scene.h"
#include "ldni/section/grid.h"
#include "ldni/section/leaf_section.h"
#include "plane/cascade/kinetic_ray.h"
#include "tests/support/contour_checks.h"
#include "tests/support/leaf_scenes.h"

namespace lamina::ldni {
namespace {

class MeshBreaker {
 public:
  explicit MeshBreaker(std::uint64_t seed) : random_(seed) {}

  csg::Mesh broken_mesh() {
    csg::Mesh mesh = whole_mesh();
    const std::size_t wounds = 1 + random_() % 6;
    for (std::size_t i = 0; i < wounds; ++i) wound(mesh);
    return mesh;
  }
  Affine placement() {
    std::mt19937 turn(static_cast<std::uint32_t>(random_()));
    return support::compose(
        support::shift_by(Vec3(share() - 0.5, share() - 0.5, share() - 0.5)),
        support::random_turn(turn));
  }
  std::size_t below(std::size_t count) { return random_() % count; }

 private:
  double share() { return static_cast<double>(random_() % 65536) / 65536; }

  csg::Mesh whole_mesh() {
    switch (below(4)) {
      case 0:
        return support::box_mesh(Vec3(-1), Vec3(1));
      case 1:
        return support::prism_mesh(7, 1.3, -1, 0.8);
      case 2:
        return support::sphere_mesh(12, 1.2);
      default:
        return support::torus_mesh(9, 1, 0.4);
    }
  }

  void wound(csg::Mesh& mesh) {
    auto& triangle = mesh.triangles[below(mesh.triangles.size())];
    switch (below(5)) {
      case 0:
        triangle = mesh.triangles.back();
        mesh.triangles.pop_back();
        break;
      case 1:
        std::swap(triangle[0], triangle[1]);
        break;
      case 2:
        mesh.triangles.push_back(std::array(triangle));
        break;
      case 3:  // torn off: a corner of its own
        mesh.vertices.push_back(Vec3(mesh.vertices[triangle[0]]));
        triangle[0] = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
        break;
      default:
        mesh.vertices[triangle[1]] += Vec3(share(), share(), share());
    }
  }

  std::mt19937_64 random_;
};

TEST(BrokenMeshes, GiveSoundLoopsAndAreCounted) {
  std::uint64_t open_paths = 0;
  std::uint64_t loops = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    MeshBreaker breaker(seed);
    csg::Scene scene =
        support::scene_of(seed % 3 == 0 ? plane::BooleanOp::kDifference
                                        : plane::BooleanOp::kUnion);
    for (std::uint32_t leaf = 0; leaf < 1 + seed % 4; ++leaf) {
      scene.leaves.push_back(
          support::mesh_leaf(breaker.broken_mesh(), breaker.below(2) == 0));
      support::place_leaf(scene, leaf, breaker.placement());
    }
    support::cover_instances(scene);
    const LayerGrid grid =
        LayerGrid::uniform(scene.box.low.z, scene.box.high.z, 0.17);
    const LeafSectioner sectioner(scene, grid);
    ldni::SectionBlock block;
    sectioner.cut(0, grid.layer_count(), block);
    open_paths += block.open_paths;
    const plane::BooleanProgram program = csg::program_of(scene);
    plane::KineticRay ray(program);
    plane::Contours contours;
    for (std::uint32_t l = 0; l < grid.layer_count(); ++l) {
      ray.sweep(block, l, contours);
      loops += contours.loop_count();
      EXPECT_TRUE(support::are_sound(contours))
          << "seed " << seed << ", layer " << l;
    }
    EXPECT_EQ(ray.counts().unbalanced_clusters, 0U) << "seed " << seed;
    EXPECT_EQ(ray.counts().repaired_clusters, 0U) << "seed " << seed;
    EXPECT_EQ(ray.counts().capped_clusters, 0U) << "seed " << seed;
  }
  EXPECT_GT(open_paths, 100U);
  EXPECT_GT(loops, 1000U);
}

}  // namespace
}  // namespace lamina::ldni
