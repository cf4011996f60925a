// The kinetic ray and the leaf sections against rays evaluated one by one, in
// random scenes that are as hard as they come. `LAMINA_FIRST_SEED` and
// `LAMINA_SEEDS` in the environment make it a longer run.

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "ldni/image/sample.h"
#include "ldni/section/grid.h"
#include "ldni/section/leaf_section.h"
#include "plane/cascade/kinetic_ray.h"
#include "plane/tie_distance.h"
#include "tests/ldni/image/ray_reference.h"
#include "tests/support/contour_checks.h"
#include "tests/support/environment.h"
#include "tests/support/random_scenes.h"

namespace lamina::ldni {
namespace {

using support::SceneStyle;

// A scene, sections through it, and rays where to look.
struct Case {
  Case(std::uint64_t seed, SceneStyle style)
      : random(seed),
        scene(support::random_scene(seed, style,
                                    2 + static_cast<int>(random() % 30))),
        layers(make_layers()) {}

  // Every other case has its sections on the faces of aligned leaves.
  LayerGrid make_layers() {
    const double low = scene.box.low.z;
    const double high = scene.box.high.z;
    if (random() % 2 == 0) return LayerGrid::uniform(low, high, 0.377);
    std::vector<double> heights;
    for (double z = std::floor(2 * low) / 2; z <= high; z += 0.25) {
      heights.push_back(z);
    }
    return LayerGrid::at_heights(heights);
  }

  double random_x() {
    return std::uniform_real_distribution<double>(
        scene.box.low.x - 0.01, scene.box.high.x + 0.01)(random);
  }

  std::mt19937_64 random;
  csg::Scene scene;
  LayerGrid layers;
};

// Ranges of the reference in one layer at any x.
RangesAt reference(const csg::Scene& scene, const LayerGrid& layers,
                   std::uint32_t layer) {
  return [&scene, &layers, layer](double x) {
    return evaluate_layers(scene, layers, x)[layer];
  };
}

// The scene of one of its instances alone.
csg::Scene only_instance(const csg::Scene& scene, std::uint32_t instance) {
  csg::Scene result;
  result.leaves = scene.leaves;
  result.program.push_back({plane::BooleanOp::kUnion, 0, false, 1});
  result.instances.push_back(scene.instances[instance]);
  result.instances[0].parent = 0;
  result.box = result.instances[0].box;
  return result;
}

void check_leaf_sections(std::uint64_t seed, SceneStyle style) {
  Case at(seed, style);
  ldni::SectionBlock block;
  for (std::uint32_t i = 0; i < at.scene.instances.size(); ++i) {
    // Among others it might not be cut.
    const csg::Scene alone = only_instance(at.scene, i);
    const LeafSectioner sectioner(alone, at.layers);
    sectioner.cut(0, at.layers.layer_count(), block);
    for (int rays = 0; rays < 2; ++rays) {
      const Box3& box = alone.box;
      double x = std::uniform_real_distribution<double>(box.low.x,
                                                        box.high.x)(at.random);
      const std::vector<Ranges> expected = evaluate_layers(alone, at.layers, x);
      for (std::uint32_t layer = 0; layer < at.layers.layer_count(); ++layer) {
        const std::string difference = compare_ranges(
            cut_chains(block, layer, 0, x), expected[layer], x,
            [&](double near) { return cut_chains(block, layer, 0, near); },
            reference(alone, at.layers, layer));
        ASSERT_EQ(difference, "")
            << "seed " << seed << " style " << static_cast<int>(style)
            << " instance " << i << " layer " << layer;
      }
    }
  }
}

// Sound, where walls coincide or are apart. Where they are nearer than a tie
// without coinciding, the loops keep to that distance: then nothing crosses by
// more.
::testing::AssertionResult are_simple(const plane::Contours& contours,
                                      SceneStyle style) {
  if (style <= SceneStyle::kNoisy) return support::are_sound(contours);
  support::ContourRules rules;
  rules.touch_distance = kTieDistance;
  for (const auto& defect : support::find_defects(contours, rules)) {
    if (defect.kind == support::ContourDefect::Kind::kCrossing) {
      return ::testing::AssertionFailure() << defect.message;
    }
  }
  return ::testing::AssertionSuccess();
}

void check_kinetic_ray(std::uint64_t seed, SceneStyle style) {
  Case at(seed, style);
  const LeafSectioner sectioner(at.scene, at.layers);
  ldni::SectionBlock block;
  sectioner.cut(0, at.layers.layer_count(), block);
  // Leaves keep to multiples of these pitches: rays run along walls.
  const double pitches[] = {0, 0.25, 0.02, 10};
  const plane::BooleanProgram program = csg::program_of(at.scene);
  plane::KineticRay ray(program, {.pitch = pitches[seed % 4]});
  std::vector<plane::Contours> contours(at.layers.layer_count());
  for (std::uint32_t layer = 0; layer < contours.size(); ++layer) {
    ray.sweep(block, layer, contours[layer]);
    ASSERT_TRUE(are_simple(contours[layer], style))
        << "seed " << seed << " style " << static_cast<int>(style) << " layer "
        << layer;
  }
  EXPECT_EQ(ray.counts().unbalanced_clusters, 0U);
  EXPECT_EQ(ray.counts().capped_clusters, 0U);
  EXPECT_EQ(ray.counts().repaired_clusters, 0U);
  for (int rays = 0; rays < 12; ++rays) {
    double x = at.random_x();
    const std::vector<Ranges> expected =
        evaluate_layers(at.scene, at.layers, x);
    for (std::uint32_t layer = 0; layer < contours.size(); ++layer) {
      const std::string difference = compare_ranges(
          cut_contours(contours[layer], x), expected[layer], x,
          [&](double near) { return cut_contours(contours[layer], near); },
          reference(at.scene, at.layers, layer));
      ASSERT_EQ(difference, "")
          << "seed " << seed << " style " << static_cast<int>(style)
          << " layer " << layer;
    }
  }
}

class CrossCheck : public ::testing::TestWithParam<int> {
 protected:
  template <typename Check>
  void run(const Check& check) {
    const std::uint64_t first = support::number_from("LAMINA_FIRST_SEED", 1);
    const std::uint64_t count = support::number_from("LAMINA_SEEDS", 25);
    for (std::uint64_t seed = first; seed < first + count; ++seed) {
      check(seed, static_cast<SceneStyle>(GetParam()));
      if (HasFatalFailure()) return;
    }
  }
};

TEST_P(CrossCheck, ChainsOfEveryLeafMeetTheSamplesOfEveryRay) {
  run(check_leaf_sections);
}

TEST_P(CrossCheck, ContoursOfTheKineticRayMeetTheIntervalsOfEveryRay) {
  run(check_kinetic_ray);
}

// Three faces through one point that all stay boundary, or a slab that begins
// inside a column: each once left a loop that touched itself.
TEST(CrossCheck, LoopsThatMeetInAPointAreApart) {
  for (const std::uint64_t seed : {1151, 1840, 2247}) {
    check_kinetic_ray(seed, SceneStyle::kAligned);
  }
  for (const std::uint64_t seed : {1390, 2130}) {
    check_kinetic_ray(seed, SceneStyle::kNoisy);
  }
}

INSTANTIATE_TEST_SUITE_P(Styles, CrossCheck,
                         ::testing::Range(0, support::kSceneStyleCount));

}  // namespace
}  // namespace lamina::ldni
