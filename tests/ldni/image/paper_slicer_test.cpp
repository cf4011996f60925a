#include "ldni/image/paper_slicer.h"

#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/contour_checks.h"
#include "tests/support/design.h"
#include "tests/support/leaf_scenes.h"
#include "tests/support/random_scenes.h"

namespace lamina::ldni {
namespace {

using csg::Scene;
using plane::BooleanOp;

// What the tests choose; the pitch is of the rays [mm].
struct Settings {
  double ray_pitch = 0.05;
  PaperOptions paper = {};
};

PaperPlan plan_of(const Scene& scene, const LayerGrid& layers,
                  const Settings& settings) {
  return make_paper_plan(scene, layers, settings.ray_pitch, settings.paper);
}

std::vector<plane::Contours> slice_all(const Scene& scene,
                                       const LayerGrid& layers,
                                       const Settings& settings,
                                       std::uint32_t layers_per_block) {
  const PaperPlan plan = plan_of(scene, layers, settings);
  PaperSlicer slicer(plan);
  std::vector<plane::Contours> result(layers.layer_count());
  for (std::uint32_t first = 0; first < result.size();
       first += layers_per_block) {
    const auto count = std::min(
        layers_per_block, static_cast<std::uint32_t>(result.size()) - first);
    slicer.sample_block(first, count);
    for (std::uint32_t i = 0; i < count; ++i) {
      slicer.build_layer(first + i, result[first + i]);
    }
  }
  return result;
}

plane::Contours slice_at(const Scene& scene, double z, double pitch) {
  Settings settings;
  settings.ray_pitch = pitch;
  return slice_all(scene, LayerGrid::at_heights({z}), settings, 1)[0];
}

// A ring of square section: a prism with a hole, both fine enough that the
// facets do not matter.
Scene ring_scene(double outer, double inner) {
  Scene scene = support::scene_of(plane::BooleanOp::kDifference);
  scene.leaves.push_back(
      support::mesh_leaf(support::prism_mesh(4096, outer, -1, 1)));
  scene.leaves.push_back(
      support::mesh_leaf(support::prism_mesh(4096, inner, -2, 2)));
  support::place_leaf(scene, 0, Affine(1.0));
  support::place_leaf(scene, 1, Affine(1.0));
  scene.box = scene.instances[0].box;
  return scene;
}

// Twelve tori and spheres in random places, some subtracted, some intersected.
Scene random_scene(std::mt19937& random) {
  Scene scene = support::scene_of(plane::BooleanOp::kUnion);
  scene.leaves.push_back(support::mesh_leaf(support::torus_mesh(20, 2, 0.6)));
  scene.leaves.push_back(support::mesh_leaf(support::sphere_mesh(16, 1.5)));
  std::uniform_real_distribution<double> place(0, 5);
  for (int i = 0; i < 3; ++i) {
    const std::uint32_t parent =
        support::add_operator(scene,
                              i == 0 ? plane::BooleanOp::kIntersection
                                     : plane::BooleanOp::kDifference,
                              0);
    for (int k = 0; k < 4; ++k) {
      support::place_leaf(
          scene, static_cast<std::uint32_t>(random() % 2),
          support::compose(
              support::shift_by({place(random), place(random), place(random)}),
              support::random_turn(random)),
          parent);
    }
  }
  support::cover_instances(scene);
  return scene;
}

TEST(PaperSlicer, AreaOfARingConvergesWithThePitch) {
  const double outer = 5;
  const double inner = 3;
  const double exact = std::numbers::pi * (outer * outer - inner * inner);
  for (const double pitch : {0.4, 0.2, 0.1, 0.05, 0.025}) {
    const plane::Contours contours =
        slice_at(ring_scene(outer, inner), 0, pitch);
    ASSERT_TRUE(support::are_sound(contours));
    EXPECT_EQ(support::count_loops(contours), (support::LoopCounts{1, 1}));
    // The caps: segments of height below the pitch p, hence of area below
    // 4/3 p √(2 r p) each, at the hole given and at the outside taken. The
    // trapezoids between err by as much again at most.
    const double bound =
        2 * 4.0 / 3 * pitch *
        (std::sqrt(2 * outer * pitch) + std::sqrt(2 * inner * pitch));
    EXPECT_NEAR(support::total_area(contours), exact, bound) << pitch;
  }
}

TEST(PaperSlicer, LosesNeverMoreThanAPitchOfABoxInX) {
  Scene scene = support::scene_of(plane::BooleanOp::kUnion);
  scene.leaves.push_back(
      support::mesh_leaf(support::box_mesh(Vec3(-2, -1, 0), Vec3(3, 4, 1))));
  support::place_leaf(scene, 0, Affine(1.0));
  support::cover_instances(scene);
  for (const double pitch : {1.0, 0.3, 0.05}) {
    const plane::Contours contours = slice_at(scene, 0.5, pitch);
    ASSERT_EQ(contours.loop_count(), 1U);
    EXPECT_EQ(contours.loop(0).size(), 4U);
    EXPECT_LE(support::total_area(contours), 25);
    EXPECT_GE(support::total_area(contours), 25 - 2 * pitch * 5);
  }
}

TEST(PaperSlicer, LosesASlitNarrowerThanThePitchThatRunsAlongTheRays) {
  // The limit that the kinetic ray removes.
  Scene scene = support::scene_of(plane::BooleanOp::kDifference);
  scene.leaves.push_back(
      support::mesh_leaf(support::box_mesh(Vec3(0), Vec3(4, 4, 1))));
  scene.leaves.push_back(
      support::mesh_leaf(support::box_mesh(Vec3(2, -1, -1), Vec3(2.01, 5, 2))));
  support::place_leaf(scene, 0, Affine(1.0));
  support::place_leaf(scene, 1, Affine(1.0));
  scene.box = scene.instances[0].box;
  EXPECT_EQ(slice_at(scene, 0.5, 0.5).loop_count(), 1U);
  EXPECT_EQ(slice_at(scene, 0.5, 0.001).loop_count(), 2U);
}

TEST(PaperSlicer, TouchingAndCoplanarSolidsLeaveNoInnerWallAndNoSkin) {
  Scene scene = support::scene_of(plane::BooleanOp::kDifference);
  const std::uint32_t joined =
      support::add_operator(scene, plane::BooleanOp::kUnion, 0);
  scene.leaves.push_back(
      support::mesh_leaf(support::box_mesh(Vec3(0), Vec3(1))));
  for (const Vec3& place :
       {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)}) {
    support::place_leaf(scene, 0, support::shift_by(place), joined);
  }
  // Cuts the upper right quarter away, flush with three of its walls.
  support::place_leaf(scene, 0, support::shift_by({1, 1, 0}));
  scene.box = {Vec3(0), Vec3(2, 2, 1)};
  const plane::Contours contours = slice_at(scene, 0.5, 0.1);
  ASSERT_TRUE(support::are_sound(contours));
  EXPECT_EQ(contours.loop_count(), 1U);
  EXPECT_NEAR(support::total_area(contours), 3, 0.5);
}

TEST(PaperSlicer, ContoursOfHardScenesAreSimpleDisjointAndOriented) {
  for (int style = 0; style < support::kSceneStyleCount; ++style) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const Scene scene = support::random_scene(
          seed, static_cast<support::SceneStyle>(style), 20);
      const LayerGrid layers =
          LayerGrid::uniform(scene.box.low.z, scene.box.high.z, 0.5);
      Settings settings;
      settings.ray_pitch = 0.07;
      for (const plane::Contours& contours :
           slice_all(scene, layers, settings, 64)) {
        ASSERT_TRUE(support::are_sound(contours))
            << "style " << style << " seed " << seed;
      }
    }
  }
}

TEST(PaperSlicer, GlobalBoxesGiveTheContoursOfLocalOnesBitForBit) {
  std::mt19937 random(1);
  for (int round = 0; round < 5; ++round) {
    const Scene scene = random_scene(random);
    const LayerGrid layers =
        LayerGrid::uniform(scene.box.low.z, scene.box.high.z, 0.1);
    Settings settings;
    settings.ray_pitch = 0.07;
    settings.paper.boxes = BoxMode::kLocal;
    const auto local = slice_all(scene, layers, settings, 16);
    settings.paper.boxes = BoxMode::kGlobal;
    const auto global = slice_all(scene, layers, settings, 16);
    for (std::size_t i = 0; i < local.size(); ++i) {
      ASSERT_TRUE(support::are_sound(local[i]));
      ASSERT_EQ(local[i].points, global[i].points);
      ASSERT_EQ(local[i].ends, global[i].ends);
    }
  }
}

TEST(PaperSlicer, BlocksOfAnySizeGiveTheSameLayers) {
  std::mt19937 random(2);
  const Scene scene = random_scene(random);
  const LayerGrid layers =
      LayerGrid::uniform(scene.box.low.z, scene.box.high.z, 0.1);
  Settings settings;
  settings.ray_pitch = 0.07;
  const auto whole = slice_all(scene, layers, settings, 1000);
  for (const std::uint32_t layers_per_block : {1, 7, 32}) {
    const auto parts = slice_all(scene, layers, settings, layers_per_block);
    for (std::size_t i = 0; i < whole.size(); ++i) {
      ASSERT_EQ(whole[i].points, parts[i].points);
      ASSERT_EQ(whole[i].ends, parts[i].ends);
    }
  }
}

TEST(PaperSlicer, CountsTheImagesThatBoxesNeed) {
  std::mt19937 random(3);
  const Scene scene = random_scene(random);
  const LayerGrid layers =
      LayerGrid::uniform(scene.box.low.z, scene.box.high.z, 0.1);
  Settings settings;
  PaperCounts counts[2];
  for (const BoxMode boxes : {BoxMode::kLocal, BoxMode::kGlobal}) {
    settings.paper.boxes = boxes;
    const PaperPlan plan = plan_of(scene, layers, settings);
    PaperSlicer slicer(plan);
    slicer.sample_block(0, layers.layer_count());
    counts[boxes == BoxMode::kGlobal] = slicer.counts();
    if (boxes == BoxMode::kGlobal) {
      EXPECT_EQ(slicer.counts().pixels(), scene.instances.size() *
                                              plan.rays.ray_count() *
                                              layers.layer_count());
    }
  }
  EXPECT_EQ(counts[0].samples, counts[1].samples);
  EXPECT_LT(counts[0].pixels(), counts[1].pixels());
}

// A ray crosses an upright torus four times in the middle and twice in the
// topmost layers; its dense image has four peels everywhere.
TEST(PaperSlicer, CountsTheMostPeelsOfAllBlocksAndThreads) {
  Scene scene = support::scene_of(plane::BooleanOp::kUnion);
  scene.leaves.push_back(support::mesh_leaf(support::torus_mesh(20, 2, 0.6)));
  support::place_leaf(scene, 0,
                      support::turn_about({0, 1, 0}, std::numbers::pi / 2));
  support::cover_instances(scene);
  const LayerGrid layers =
      LayerGrid::uniform(scene.box.low.z, scene.box.high.z, 0.1);
  const PaperPlan plan = plan_of(scene, layers, {});
  PaperSlicer slicers[] = {PaperSlicer(plan), PaperSlicer(plan)};
  for (std::uint32_t layer = 0; layer < layers.layer_count(); ++layer) {
    slicers[layer == 0 ? 0 : 1].sample_block(layer, 1);
  }
  EXPECT_EQ(slicers[0].counts().leaves[0].peels, 2U);
  PaperCounts sum;
  for (const PaperSlicer& slicer : slicers) sum += slicer.counts();
  EXPECT_EQ(sum.dense_image_bytes(), 7 * 4 * sum.pixels());
}

TEST(PaperSlicer, AnEmptySceneHasEmptyLayers) {
  const Scene scene = support::scene_of(plane::BooleanOp::kUnion);
  EXPECT_TRUE(slice_at(scene, 0, 0.1).is_empty());
}

// All layers, for a choice of sampler and boxes.
std::vector<plane::Contours> slice_by(SamplerKind sampler, BoxMode boxes,
                                      const Scene& scene, PaperCounts& counts) {
  const LayerGrid layers =
      LayerGrid::uniform(scene.box.low.z, scene.box.high.z, 0.05);
  Settings settings;
  settings.paper.sampler = sampler;
  settings.paper.boxes = boxes;
  const PaperPlan plan = plan_of(scene, layers, settings);
  EXPECT_EQ(plan.renderer.empty(), sampler == SamplerKind::kScanline);
  PaperSlicer slicer(plan);
  std::vector<plane::Contours> result(layers.layer_count());
  for (std::uint32_t first = 0; first < result.size(); first += 16) {
    const auto count =
        std::min(16U, static_cast<std::uint32_t>(result.size()) - first);
    slicer.sample_block(first, count);
    for (std::uint32_t i = first; i < first + count; ++i) {
      slicer.build_layer(i, result[i]);
    }
  }
  counts = slicer.counts();
  return result;
}

TEST(PaperSlicer, LayersDrawnByOpenGlAreThoseOfTheExactSampler) {
  for (const char* const name : {"ring55.scad", "submarine74.scad"}) {
    const auto design = support::Design::from_file(
        std::filesystem::path(LAMINA_BENCH_SCENES) / name);
    PaperCounts counts;
    const auto expected = slice_by(SamplerKind::kScanline, BoxMode::kLocal,
                                   design.scene(), counts);
    EXPECT_EQ(counts.repaired_pixels, 0U);
    std::vector<std::vector<plane::Contours>> drawn;
    for (const BoxMode boxes : {BoxMode::kLocal, BoxMode::kGlobal}) {
      drawn.push_back(
          slice_by(SamplerKind::kGl, boxes, design.scene(), counts));
      EXPECT_EQ(counts.repaired_pixels, 0U);
    }
    // A wall moves by 1/256 of pitch and thickness, and by its slope; and a ray
    // that runs along a wall can see it or not.
    const double height = design.scene().box.high.y - design.scene().box.low.y;
    double sum = 0;
    double expected_sum = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      ASSERT_TRUE(support::are_sound(drawn[0][i])) << name << " layer " << i;
      const double area = support::total_area(drawn[0][i]);
      const double expected_area = support::total_area(expected[i]);
      EXPECT_NEAR(area, expected_area, 1e-3 * expected_area + 0.05 * height)
          << name << " layer " << i;
      sum += area;
      expected_sum += expected_area;
      for (const auto& other : drawn) {
        EXPECT_EQ(other[i].points, drawn[0][i].points);
        EXPECT_EQ(other[i].ends, drawn[0][i].ends);
      }
    }
    EXPECT_NEAR(sum, expected_sum, 2e-4 * expected_sum) << name;
  }
}

TEST(PaperSlicer, CoplanarFacesLeaveNoWallAndNoSkinWhenDrawn) {
  // A block out of two that meet at y1, less a third that is flush with all
  // sides of what is beyond y2: the block up to y2. Depths rounded to the 32
  // bits of a depth buffer, by each leaf's own scale, would leave walls and
  // skins here.
  std::mt19937 random(17);
  std::uniform_real_distribution<double> part(0.2, 0.8);
  for (int round = 0; round < 10; ++round) {
    const double length = 100 * part(random);
    const double y1 = length * part(random);
    const double y2 = length * part(random);
    Scene scene = support::scene_of(plane::BooleanOp::kDifference);
    const std::uint32_t joined =
        support::add_operator(scene, plane::BooleanOp::kUnion, 0);
    // Each leaf has a part above the layers too, so that its depths begin
    // somewhere else.
    const auto place = [&](double low, double high, std::uint32_t parent) {
      csg::Mesh mesh = support::box_mesh(Vec3(0, low, 0), Vec3(20, high, 2));
      const csg::Mesh above =
          support::box_mesh(Vec3(0, -length * part(random), 5), Vec3(20, 0, 6));
      for (const auto& [i, j, k] : above.triangles) {
        mesh.triangles.push_back({i + 8, j + 8, k + 8});
      }
      mesh.vertices.insert(mesh.vertices.end(), above.vertices.begin(),
                           above.vertices.end());
      scene.leaves.push_back(support::mesh_leaf(std::move(mesh)));
      const auto leaf = static_cast<std::uint32_t>(scene.leaves.size() - 1);
      support::place_leaf(scene, leaf, Affine(1.0), parent);
    };
    place(0, y1, joined);
    place(y1, length, joined);
    place(y2, length, 0);
    support::cover_instances(scene);
    const LayerGrid layers = LayerGrid::uniform(0, 2, 0.5);
    Settings settings;
    settings.ray_pitch = 0.3;
    settings.paper.sampler = SamplerKind::kGl;
    for (const plane::Contours& contours :
         slice_all(scene, layers, settings, 4)) {
      ASSERT_EQ(contours.loop_count(), 1U);
      EXPECT_EQ(contours.loop(0).size(), 4U);
      EXPECT_NEAR(support::total_area(contours), 20 * y2, 0.6 * y2);
    }
  }
}

}  // namespace
}  // namespace lamina::ldni
