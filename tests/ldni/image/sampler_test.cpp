// The contract of all samplers, and what only the exact one promises.

#include "ldni/image/sampler.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "csg/boundary/leaf_mesh.h"
#include "tests/ldni/image/samplers.h"
#include "tests/support/leaf_scenes.h"

namespace lamina::ldni {
namespace {

using csg::Scene;

// One leaf, placed once or more.
Scene scene_with(csg::Mesh mesh, const std::vector<Affine>& placements) {
  Scene scene = support::scene_of(plane::BooleanOp::kUnion);
  scene.leaves.push_back(support::mesh_leaf(std::move(mesh)));
  for (const Affine& placement : placements) {
    support::place_leaf(scene, 0, placement);
  }
  support::cover_instances(scene);
  return scene;
}

// A scene with its grids and the images of all its instances.
struct Sampled {
  Sampled(SamplerKind kind, Scene scene_in, double pitch, double thickness,
          BoxMode boxes = BoxMode::kLocal)
      : scene(std::move(scene_in)),
        rays(scene.box.low.x, scene.box.high.x, pitch),
        layers(
            LayerGrid::uniform(scene.box.low.z, scene.box.high.z, thickness)) {
    const auto sampler = make_sampler(kind, scene, rays, layers);
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
      const GridBox box = boxes == BoxMode::kLocal
                              ? local_box(scene.instances[i].box, rays, layers)
                              : global_box(rays, layers);
      sampler->sample({i, box}, images);
    }
    // No rasteriser that is exact on its grid needs help.
    EXPECT_EQ(sampler->repaired_pixels(), 0U);
  }

  // Samples of a pixel by global indices, by depth; none outside of the box.
  std::vector<Sample> ray(std::size_t image_index, std::uint32_t layer,
                          std::uint32_t ray_index) const {
    const LeafImage& image = images.images[image_index];
    const GridBox& box = image.box;
    if (ray_index < box.ray_start || ray_index >= box.ray_end() ||
        layer < box.layer_start || layer >= box.layer_end()) {
      return {};
    }
    const auto found =
        images.ray(image, layer - box.layer_start, ray_index - box.ray_start);
    std::vector<Sample> sorted(found.begin(), found.end());
    std::sort(sorted.begin(), sorted.end(),
              [](const Sample& a, const Sample& b) {
                return a.depth != b.depth ? a.depth < b.depth
                                          : a.is_entry() && !b.is_entry();
              });
    return sorted;
  }

  Scene scene;
  RayGrid rays;
  LayerGrid layers;
  LeafImages images;
};

// Every pixel is entered as often as left, and a ray is inside where it must
// be: the sum of entries never falls below 0 on the way up.
void expect_balanced(const Sampled& sampled) {
  for (std::size_t i = 0; i < sampled.images.images.size(); ++i) {
    for (std::uint32_t layer = 0; layer < sampled.layers.layer_count();
         ++layer) {
      for (std::uint32_t ray = 0; ray < sampled.rays.ray_count(); ++ray) {
        int entries = 0;
        for (const Sample& sample : sampled.ray(i, layer, ray)) {
          entries += sample.is_entry() ? 1 : -1;
        }
        ASSERT_EQ(entries, 0) << "layer " << layer << " ray " << ray;
      }
    }
  }
}

double sampled_volume(const Sampled& sampled, double thickness) {
  double volume = 0;
  for (const Sample& sample : sampled.images.samples) {
    volume += sample.is_entry() ? -sample.depth : sample.depth;
  }
  return volume * sampled.rays.pitch() * thickness;
}

class Samplers : public ::testing::TestWithParam<SamplerKind> {
 protected:
  bool is_exact() const { return GetParam() == SamplerKind::kScanline; }
};

INSTANTIATE_TEST_SUITE_P(Kinds, Samplers,
                         ::testing::Values(SamplerKind::kScanline,
                                           SamplerKind::kGl),
                         [](const auto& kind) {
                           return ::testing::PrintToString(kind.param);
                         });

TEST_P(Samplers, GivesTheDepthImageOfABox) {
  // Rays at 0.618, 1.618; layers at 0.5, 1.5, 2.5.
  const Sampled sampled(
      GetParam(),
      scene_with(support::box_mesh(Vec3(0, -1, 0), Vec3(2, 4, 3)),
                 {Affine(1.0)}),
      1, 1);
  ASSERT_EQ(sampled.images.images.size(), 1U);
  ASSERT_EQ(sampled.images.images[0].box.pixel_count(), 6U);
  for (std::uint32_t layer = 0; layer < 3; ++layer) {
    for (std::uint32_t ray = 0; ray < 2; ++ray) {
      const std::vector<Sample> samples = sampled.ray(0, layer, ray);
      ASSERT_EQ(samples.size(), 2U);
      EXPECT_EQ(samples[0].depth, -1);
      EXPECT_EQ(samples[0].normal, glm::vec3(0, -1, 0));
      EXPECT_EQ(samples[1].depth, 4);
      EXPECT_EQ(samples[1].normal, glm::vec3(0, 1, 0));
    }
  }
}

TEST_P(Samplers, GivesTheDepthImageOfAWedge) {
  // The triangle (0,0) (4,0) (0,4): rays at 0.618 … 3.618 leave it at 4 - x.
  const double low_x = 0;
  csg::Mesh wedge;
  wedge.vertices = {{low_x, 0, 0}, {4, 0, 0}, {low_x, 4, 0},
                    {low_x, 0, 1}, {4, 0, 1}, {low_x, 4, 1}};
  wedge.triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3},
                     {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
  const Sampled sampled(GetParam(), scene_with(wedge, {Affine(1.0)}), 1, 1);
  ASSERT_EQ(sampled.rays.ray_count(), 4U);
  for (std::uint32_t ray = 0; ray < 4; ++ray) {
    const std::vector<Sample> samples = sampled.ray(0, 0, ray);
    ASSERT_EQ(samples.size(), 2U);
    EXPECT_EQ(samples[0].depth, 0);
    EXPECT_NEAR(samples[1].depth, 4 - sampled.rays.ray_x(ray), 1e-14);
    EXPECT_NEAR(samples[1].normal.x, std::numbers::sqrt2 / 2, 1e-7);
    EXPECT_NEAR(samples[1].normal.y, std::numbers::sqrt2 / 2, 1e-7);
    EXPECT_EQ(samples[1].normal.z, 0);
  }
}

TEST_P(Samplers, FillsASolidFromItsBottomUpToBelowItsTop) {
  // Sections exactly on bottom, middle and top of a box: [bottom, top).
  const Scene scene = scene_with(
      support::box_mesh(Vec3(0, 0, 0), Vec3(2, 2, 2)), {Affine(1.0)});
  const RayGrid rays(0, 2, 1);
  const LayerGrid layers = LayerGrid::uniform(-0.5, 2.5, 1);
  const auto sampler = make_sampler(GetParam(), scene, rays, layers);
  LeafImages images;
  sampler->sample({0, global_box(rays, layers)}, images);
  const LeafImage& image = images.images[0];
  for (const std::uint32_t ray : {0U, 1U}) {
    EXPECT_EQ(images.ray(image, 0, ray).size(), 2U);
    EXPECT_EQ(images.ray(image, 1, ray).size(), 2U);
    EXPECT_EQ(images.ray(image, 2, ray).size(), 0U);
  }
}

TEST_P(Samplers, GivesEveryRayAnEvenNumberOfSamplesInAnyOrientation) {
  std::mt19937 random(3);
  const std::vector<csg::Mesh> meshes = {
      support::box_mesh(Vec3(-1), Vec3(1)), support::sphere_mesh(12, 1.5),
      support::prism_mesh(6, 1, -1, 1), support::torus_mesh(16, 2, 0.5),
      // Slivers: a thousand times longer than wide.
      support::prism_mesh(200, 0.1, -5, 5)};
  std::vector<Affine> placements;
  for (int quarters = 0; quarters < 4; ++quarters) {
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1),
                             Vec3(1, 1, 0), Vec3(1, 1, 1)}) {
      placements.push_back(
          support::turn_about(axis, quarters * std::numbers::pi / 4));
    }
  }
  for (int i = 0; i < 10; ++i)
    placements.push_back(support::random_turn(random));
  // Flattened, mirrored and sheared ones.
  placements.push_back(support::scale_by({1, 1, 1e-3}));
  placements.push_back(support::scale_by({1e-4, 1, -1}));
  placements.push_back(support::compose(support::random_turn(random),
                                        support::scale_by({3, 0.001, -0.2})));
  for (const csg::Mesh& mesh : meshes) {
    for (const Affine& placement : placements) {
      // Thicknesses that put sections through vertices, and one that does not.
      for (const double thickness : {0.25, 0.1, 0.0381966}) {
        expect_balanced(
            Sampled(GetParam(), scene_with(mesh, {placement}), 0.1, thickness));
      }
    }
  }
}

TEST_P(Samplers, GivesAnEvenNumberWhereRaysAndSectionsMeetVertices) {
  const csg::Mesh octahedron = {
      {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{0, 1, 4},
       {1, 2, 4},
       {2, 3, 4},
       {3, 0, 4},
       {1, 0, 5},
       {2, 1, 5},
       {3, 2, 5},
       {0, 3, 5}}};
  const Scene scene = scene_with(octahedron, {Affine(1.0)});
  const double pitch = 0.25;
  const double share = RayGrid(0, 1, pitch).ray_x(0);
  const RayGrid rays(-1 - share, 1.5, pitch);  // at -1, -0.75, … to rounding
  const LayerGrid layers = LayerGrid::uniform(-1.125, 1.125, 0.25);
  const auto sampler = make_sampler(GetParam(), scene, rays, layers);
  LeafImages images;
  sampler->sample({0, global_box(rays, layers)}, images);
  const LeafImage& image = images.images[0];
  for (std::uint32_t layer = 0; layer < 9; ++layer) {
    const double half = 1 - std::abs(layers.section_z(layer));
    for (std::uint32_t ray = 0; ray < rays.ray_count(); ++ray) {
      const auto found = images.ray(image, layer, ray);
      ASSERT_EQ(found.size() % 2, 0U);
      double length = 0;
      for (const Sample& sample : found) {
        length += sample.is_entry() ? -sample.depth : sample.depth;
      }
      const double expected = 2 * (half - std::abs(rays.ray_x(ray)));
      EXPECT_NEAR(length, std::max(expected, 0.0), 1e-12);
    }
  }
}

TEST(ScanlineSampler, DepthsOfASphereLieBetweenItsFacetsAndItsSurface) {
  const double r = 5;
  const int sides = 96;
  const Sampled sampled(SamplerKind::kScanline,
                        scene_with(support::sphere_mesh(sides, r),
                                   {support::turn_about({1, 2, 3}, 1)}),
                        0.2, 0.2);
  // Greatest distance of a facet from the sphere: a quad's half diagonal seen
  // from the centre spans at most half a step both ways.
  const double step = std::numbers::pi / sides;
  const double inner = r * (1 - 2 * (1 - std::cos(step)));
  std::size_t count = 0;
  for (std::uint32_t layer = 0; layer < sampled.layers.layer_count(); ++layer) {
    for (std::uint32_t ray = 0; ray < sampled.rays.ray_count(); ++ray) {
      for (const Sample& sample : sampled.ray(0, layer, ray)) {
        const Vec3 point(sampled.rays.ray_x(ray), sample.depth,
                         sampled.layers.section_z(layer));
        ASSERT_LE(glm::length(point), r + 1e-12);
        ASSERT_GE(glm::length(point), inner);
        ASSERT_GE(glm::dot(Vec3(sample.normal), point / r), 0.99);
        ++count;
      }
    }
  }
  EXPECT_GT(count, 3000U);
}

TEST_P(Samplers, SumsUpToTheVolumeInAnyOrientation) {
  std::mt19937 random(5);
  const double volume = 12 / 2.0 * std::sin(2 * std::numbers::pi / 12) * 4 * 3;
  for (int i = 0; i < 10; ++i) {
    const Sampled sampled(GetParam(),
                          scene_with(support::prism_mesh(12, 2, 0, 3),
                                     {support::random_turn(random)}),
                          0.02, 0.02);
    EXPECT_NEAR(sampled_volume(sampled, 0.02), volume, 0.002 * volume);
  }
}

TEST_P(Samplers, MirroredLeavesKeepTheirInsideInside) {
  const Affine turn = support::turn_about({3, 1, 2}, 0.7);
  const csg::Mesh mesh = support::torus_mesh(24, 2, 0.7);
  const double expected = sampled_volume(
      Sampled(GetParam(), scene_with(mesh, {turn}), 0.05, 0.05), 0.05);
  EXPECT_GT(expected, 15);
  for (const Vec3& mirror :
       {Vec3(-1, 1, 1), Vec3(1, -1, 1), Vec3(1, 1, -1), Vec3(-1, -1, -1)}) {
    const Affine placement = support::compose(turn, support::scale_by(mirror));
    const Sampled sampled(GetParam(), scene_with(mesh, {placement}), 0.05,
                          0.05);
    expect_balanced(sampled);
    // The torus is its own mirror image.
    EXPECT_NEAR(sampled_volume(sampled, 0.05), expected,
                is_exact() ? 1e-9 : 1e-4 * expected);
  }
}

TEST_P(Samplers, NormalsOfAScaledLeafArePerpendicularToItsFaces) {
  // A cube scaled 1 : 10 and sheared; its face x + y = const becomes oblique.
  Affine placement(1.0);
  placement[0] = Vec3(2, 0.5, 0);
  placement[1] = Vec3(-1, 3, 0.2);
  placement[2] = Vec3(0.3, 0.1, 4);
  const Sampled sampled(
      GetParam(), scene_with(support::box_mesh(Vec3(0), Vec3(1)), {placement}),
      0.1, 0.1);
  const std::vector<Vec3> normals = {
      glm::normalize(glm::cross(placement[1], placement[2])),
      glm::normalize(glm::cross(placement[2], placement[0])),
      glm::normalize(glm::cross(placement[0], placement[1]))};
  ASSERT_GT(sampled.images.samples.size(), 100U);
  for (const Sample& sample : sampled.images.samples) {
    double best = 0;
    for (const Vec3& normal : normals) {
      best = std::max(best, std::abs(glm::dot(normal, Vec3(sample.normal))));
    }
    ASSERT_NEAR(best, 1, 1e-6);
  }
}

TEST_P(Samplers, GlobalBoxesGiveTheSamplesOfLocalOnesBitForBit) {
  std::mt19937 random(6);
  std::vector<Affine> placements;
  for (int i = 0; i < 12; ++i) {
    const auto shift = [&] {
      return 0.01 * static_cast<double>(random() % 600);
    };
    placements.push_back(
        support::compose(support::shift_by({shift(), shift(), shift()}),
                         support::random_turn(random)));
  }
  const Scene scene = scene_with(support::sphere_mesh(20, 1), placements);
  const Sampled local(GetParam(), scene, 0.1, 0.1, BoxMode::kLocal);
  const Sampled global(GetParam(), scene, 0.1, 0.1, BoxMode::kGlobal);
  EXPECT_LT(local.images.ends.size(), global.images.ends.size() / 8);
  EXPECT_EQ(local.images.samples.size(), global.images.samples.size());
  for (std::size_t i = 0; i < placements.size(); ++i) {
    for (std::uint32_t layer = 0; layer < local.layers.layer_count(); ++layer) {
      for (std::uint32_t ray = 0; ray < local.rays.ray_count(); ++ray) {
        const std::vector<Sample> a = local.ray(i, layer, ray);
        const std::vector<Sample> b = global.ray(i, layer, ray);
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t k = 0; k < a.size(); ++k) {
          ASSERT_EQ(a[k].depth, b[k].depth);
          ASSERT_EQ(a[k].normal, b[k].normal);
          ASSERT_EQ(a[k].instance, b[k].instance);
        }
      }
    }
  }
}

TEST_P(Samplers, ShiftsOfTheLeafShiftTheDepths) {
  const csg::Mesh mesh = support::torus_mesh(20, 2, 0.6);
  const Affine turn = support::turn_about({1, 0.3, 0.2}, 0.9);
  const Sampled still(GetParam(), scene_with(mesh, {turn}), 0.1, 0.1);
  const Sampled shifted(
      GetParam(),
      scene_with(mesh, {support::compose(support::shift_by({0, 7, 0}), turn)}),
      0.1, 0.1);
  ASSERT_EQ(still.images.samples.size(), shifted.images.samples.size());
  for (std::uint32_t layer = 0; layer < still.layers.layer_count(); ++layer) {
    for (std::uint32_t ray = 0; ray < still.rays.ray_count(); ++ray) {
      const std::vector<Sample> a = still.ray(0, layer, ray);
      const std::vector<Sample> b = shifted.ray(0, layer, ray);
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t k = 0; k < a.size(); ++k) {
        ASSERT_NEAR(a[k].depth + 7, b[k].depth, 1e-12);
      }
    }
  }
}

// --- Lofts -----------------------------------------------------------------

using Outline = std::vector<Vec2>;

csg::Loft make_loft(Outline outline, std::vector<Vec2> profile,
                    bool is_closed_profile = false, bool is_cavity = false) {
  return {std::make_shared<const Outline>(std::move(outline)),
          std::move(profile), is_closed_profile, is_cavity};
}

Outline circle(int sides, double r) {
  Outline points;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    points.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  return points;
}

csg::Leaf loft_leaf(std::vector<csg::Loft> lofts) {
  csg::Leaf leaf;
  leaf.lofts = std::move(lofts);
  return leaf;
}

// Leaves of every kind of loft: cylinder, cone to an apex, double cone, torus,
// a comb (its caps are cut into many segments), and a tube with a cavity.
std::vector<csg::Leaf> loft_leaves() {
  const Outline comb = {{0, 0}, {5, 0}, {5, 3}, {4, 3}, {4, 1}, {3, 1},
                        {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  return {
      loft_leaf({make_loft(circle(24, 1), {{2, -1}, {2, 1.5}})}),
      loft_leaf({make_loft(circle(24, 1), {{2, -1}, {0, 1.5}})}),
      loft_leaf({make_loft(circle(9, 1), {{0, -1}, {2, 0}, {0, 1.5}})}),
      loft_leaf({make_loft(circle(20, 1),
                           {{3, -0.5}, {3.5, 0}, {3, 0.5}, {2.5, 0}}, true)}),
      loft_leaf({make_loft(comb, {{1, 0}, {0.5, 2}})}),
      loft_leaf({make_loft(circle(24, 3), {{1, 0}, {1, 2}}),
                 make_loft(circle(12, 2), {{1, 0}, {1, 2}}, false, true)}),
  };
}

// `leaf` as it is and as its explicit mesh, in the same place.
Scene scene_with_both(csg::Leaf leaf, const Affine& placement) {
  Scene scene = support::scene_of(plane::BooleanOp::kUnion);
  scene.leaves.push_back(support::mesh_leaf(csg::explicit_mesh(leaf)));
  scene.leaves.push_back(std::move(leaf));
  support::place_leaf(scene, 0, placement);
  support::place_leaf(scene, 1, placement);
  scene.instances[1].box = scene.instances[0].box;
  support::cover_instances(scene);
  return scene;
}

TEST_P(Samplers, LoftsGiveTheSamplesOfTheirExplicitMeshes) {
  std::mt19937 random(8);
  for (const csg::Leaf& leaf : loft_leaves()) {
    for (int round = 0; round < 8; ++round) {
      Affine placement = support::random_turn(random);
      if (round % 2 == 1) {
        placement = support::compose(placement, support::scale_by({1, -2, 3}));
      }
      const Sampled sampled(GetParam(), scene_with_both(leaf, placement), 0.13,
                            0.11);
      expect_balanced(sampled);
      std::size_t count = 0;
      for (std::uint32_t layer = 0; layer < sampled.layers.layer_count();
           ++layer) {
        for (std::uint32_t ray = 0; ray < sampled.rays.ray_count(); ++ray) {
          // Caps of cavities are crossed twice in one place, by either at
          // will, so depths are compared by their signed sum.
          double lengths[2] = {0, 0};
          for (std::size_t i = 0; i < 2; ++i) {
            for (const Sample& sample : sampled.ray(i, layer, ray)) {
              lengths[i] += sample.is_entry() ? -sample.depth : sample.depth;
              ++count;
            }
          }
          ASSERT_NEAR(lengths[0], lengths[1], 1e-9);
        }
      }
      EXPECT_GT(count, 500U);
    }
  }
}

TEST_P(Samplers, NormalsOfLoftsAreThoseOfTheirMeshes) {
  const Affine placement = support::compose(
      support::turn_about({1, 2, 0.5}, 0.8), support::scale_by({1, 1, -1}));
  // Without cavities, so that samples correspond one to one.
  for (std::size_t kind = 0; kind < 5; ++kind) {
    const Sampled sampled(GetParam(),
                          scene_with_both(loft_leaves()[kind], placement), 0.13,
                          0.11);
    for (std::uint32_t layer = 0; layer < sampled.layers.layer_count();
         ++layer) {
      for (std::uint32_t ray = 0; ray < sampled.rays.ray_count(); ++ray) {
        const std::vector<Sample> a = sampled.ray(0, layer, ray);
        const std::vector<Sample> b = sampled.ray(1, layer, ray);
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i) {
          ASSERT_NEAR(a[i].depth, b[i].depth, 1e-9);
          ASSERT_NEAR(glm::dot(a[i].normal, b[i].normal), 1, 1e-5);
        }
      }
    }
  }
}

}  // namespace
}  // namespace lamina::ldni
