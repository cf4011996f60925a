// Random scenes full of coincident faces, judged point by point.
//
// Beside every edge of the result and beside every edge of every leaf's
// section, on both sides, and at random places, the contours must say what the
// definition of the operators says of the leaves: contours that were swept as
// ever, contours of a cascade without patience, and contours of clipped chains.
// LAMINA_RANDOM_SCENES sets how many scenes are tried, LAMINA_RANDOM_SEED the
// first seed.

#include "tests/support/random_scenes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <random>
#include <string>

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include "csg/scene.h"
#include "ldni/image/sample.h"
#include "ldni/section/grid.h"
#include "ldni/section/leaf_section.h"
#include "plane/cascade/cascade.h"
#include "plane/cascade/chain_clipper.h"
#include "plane/cascade/kinetic_ray.h"
#include "plane/tie_distance.h"
#include "tests/ldni/support/scene_builder.h"
#include "tests/plane/cascade/section_reference.h"
#include "tests/support/contour_checks.h"
#include "tests/support/environment.h"
#include "tests/support/leaf_scenes.h"

namespace lamina::plane {
namespace {

using support::number_from;
using support::SceneStyle;
using testing::SectionReference;

struct Tally {
  std::uint64_t scenes = 0;
  std::uint64_t layers = 0;
  std::uint64_t probes = 0;
  std::uint64_t failures = 0;
  std::uint64_t resolved_layers = 0;  // of those swept as ever
};

// What a style promises. Where faces stand apart by less than a tie, either
// reading is right, and only points farther from every face are judged.
struct Rules {
  double scale = 1;          // of the scene
  double beside = 1e-7;      // of probes from an edge [mm]
  double least_edge = 1e-4;  // shorter edges are not probed
  double doubtful = 0;       // points nearer to a face are not judged
};
Rules rules_of(SceneStyle style, double scale) {
  Rules rules;
  rules.scale = scale;
  // In a small scene many faces pass within a tie of others.
  if (style > SceneStyle::kNoisy || scale < 1) {
    rules.beside = 1e-5;
    rules.least_edge = 1e-3;
    rules.doubtful = 4 * kTieDistance;
  }
  return rules;
}

class SceneJudge {
 public:
  SceneJudge(std::uint64_t seed, SceneStyle style, double scale, Tally& tally)
      : random_(seed),
        rules_(rules_of(style, scale)),
        tally_(tally),
        name_("seed " + std::to_string(seed) + ", style " +
              std::to_string(static_cast<int>(style))) {}

  void judge(const csg::Scene& scene, double pitch) {
    ++tally_.scenes;
    const double height = scene.box.high.z - scene.box.low.z;
    if (scene.box.is_empty() || height < 1e-3 * rules_.scale) return;
    // Layers whose heights fall on faces as often as not.
    const double thickness =
        random_() % 2 == 0 ? 0.25 * rules_.scale : height / 17.3;
    const ldni::LayerGrid grid =
        ldni::LayerGrid::uniform(scene.box.low.z, scene.box.high.z, thickness);
    const ldni::LeafSectioner sectioner(scene, grid);
    sectioner.cut(0, grid.layer_count(), block_);
    const BooleanProgram program = csg::program_of(scene);
    KineticRay ray(program, {.pitch = pitch});
    const SweepOptions options{.pitch = pitch};
    Cascade cascade(program, options, 0);
    Cascade clipped(program, options);
    ChainClipper clipper(program);
    SectionReference reference(scene);
    for (std::uint32_t l = 0; l < grid.layer_count(); ++l) {
      ++tally_.layers;
      reference.cut(grid.section_z(l), grid.threshold(l));
      where_ = name_ + ", layer " + std::to_string(l);
      ray.sweep(block_, l, contours_);
      judge_layer(scene, reference);
      where_ += ", cascaded";
      cascade.sweep(block_.chains_of(l), contours_);
      judge_layer(scene, reference);
      where_ = name_ + ", layer " + std::to_string(l) + ", clipped";
      clipper.begin(block_.chains_of(l));
      clipped.sweep(clipper.clip(), contours_);
      judge_layer(scene, reference);
    }
    tally_.resolved_layers += ray.counts().resolved_layers;
    for (const SweepCounts& counts :
         {ray.counts(), cascade.counts(), clipped.counts()}) {
      EXPECT_EQ(counts.unbalanced_clusters, 0U) << name_;
      EXPECT_EQ(counts.capped_clusters, 0U) << name_;
      EXPECT_EQ(counts.repaired_clusters, 0U) << name_;
    }
  }

 private:
  // Where faces stand apart by 1e-9 mm, so may edges of a loop; nothing crosses
  // in any case.
  static bool is_nearness(support::ContourDefect::Kind kind) {
    using Kind = support::ContourDefect::Kind;
    return kind == Kind::kTouchesItself || kind == Kind::kOverlap;
  }

  void judge_layer(const csg::Scene& scene, const SectionReference& reference) {
    for (const auto& defect : support::find_defects(contours_)) {
      if (rules_.doubtful > 0 && is_nearness(defect.kind)) continue;
      ++tally_.failures;
      ADD_FAILURE() << where_ << ": " << defect.message;
    }
    for (std::size_t i = 0; i < contours_.loop_count(); ++i) {
      const auto loop = contours_.loop(i);
      for (std::size_t k = 0; k < loop.size(); ++k) {
        probe_beside(reference, loop[k], loop[(k + 1) % loop.size()], "loop");
      }
    }
    for (const auto& segment : reference.segments()) {
      probe_beside(reference, segment.from, segment.to, "leaf");
    }
    std::uniform_real_distribution<double> unit(0, 1);
    for (int i = 0; i < 20; ++i) {
      const Vec3 size = scene.box.high - scene.box.low;
      probe(reference,
            Vec2(scene.box.low) +
                Vec2(unit(random_) * size.x, unit(random_) * size.y),
            "random point");
    }
  }

  void probe_beside(const SectionReference& reference, const Vec2& from,
                    const Vec2& to, const char* what) {
    const Vec2 along = to - from;
    const double length = std::hypot(along.x, along.y);
    if (length < rules_.least_edge) return;
    const Vec2 normal(-along.y / length, along.x / length);
    std::uniform_real_distribution<double> middle(0.2, 0.8);
    const Vec2 place = from + middle(random_) * along;
    probe(reference, place + rules_.beside * normal, what);
    probe(reference, place - rules_.beside * normal, what);
  }

  void probe(const SectionReference& reference, const Vec2& point,
             const char* what) {
    const bool expected = reference.contains(point);
    const bool actual = support::contains(contours_, point);
    ++tally_.probes;
    if (expected == actual) return;
    // Only judged where no face is nearer than the style's doubt, or than half
    // the probe's own distance (two faces may cross there).
    const double distance = reference.distance(point);
    if (distance < std::max(rules_.doubtful, 0.5 * rules_.beside)) return;
    ++tally_.failures;
    ADD_FAILURE() << where_ << ": " << what << " probe at " << std::scientific
                  << point.x << ' ' << point.y << ", " << distance
                  << " mm from a face, should be "
                  << (expected ? "inside" : "outside");
  }

  std::mt19937_64 random_;
  Rules rules_;
  Tally& tally_;
  std::string name_;
  std::string where_;
  ldni::SectionBlock block_;
  Contours contours_;
};

void judge_seed(std::uint64_t seed, Tally& tally) {
  const double pitches[] = {0, 0.02, 0.0762, 0.5, 10};
  const auto style = static_cast<SceneStyle>(seed % support::kSceneStyleCount);
  const int leaves = 2 + static_cast<int>(seed / 7 % 11);
  const csg::Scene scene = support::random_scene(seed, style, leaves);
  SceneJudge(seed, style, 1, tally).judge(scene, pitches[seed / 6 % 5]);
}

TEST(RandomScenes, EveryProbeBesideAnEdgeAgreesWithTheLeaves) {
  const std::uint64_t count = number_from("LAMINA_RANDOM_SCENES", 240);
  const std::uint64_t first_seed = number_from("LAMINA_RANDOM_SEED", 1);
  Tally tally;
  for (std::uint64_t seed = first_seed; seed < first_seed + count; ++seed) {
    judge_seed(seed, tally);
    if (::testing::Test::HasFatalFailure() || tally.failures > 200) break;
  }
  std::cout << tally.scenes << " scenes, " << tally.layers << " layers, "
            << tally.probes << " probes, " << tally.failures << " failures\n";
}

// From 1e-3 to 1e4 mm, about the origin and far from it, where rounding is
// 2e-12 mm.
TEST(RandomScenes, SizeAndPlaceDoNotMatter) {
  struct Placement {
    double scale;
    double shift;
  };
  constexpr Placement kPlacements[] = {{1e-2, 0}, {1e-2, 5}, {1, 1e3},
                                       {1, 1e4},  {1e3, 0},  {1e3, 1e4}};
  Tally tally;
  for (std::uint64_t seed = 1; seed <= number_from("LAMINA_RANDOM_SCENES", 120);
       ++seed) {
    // Faces that coincide, or are well apart.
    const auto style = static_cast<SceneStyle>(seed % 3);
    const int leaves = 2 + static_cast<int>(seed / 3 % 17);
    const auto& [scale, shift] = kPlacements[seed / 3 % 6];
    const csg::Scene scene = support::placed_scene(
        support::random_scene(seed, style, leaves),
        support::compose(
            support::shift_by(Vec3(shift, -0.7 * shift, 0.3 * shift)),
            support::scale_by(Vec3(scale))));
    SceneJudge(seed, style, scale, tally).judge(scene, 0);
  }
  EXPECT_EQ(tally.failures, 0U);
}

// Leaves that lie apart, touch a neighbour, lie inside or outside of a large
// one, or cross its boundary: most are decided without a sweep, or not cut.
class ScatteredScene {
 public:
  explicit ScatteredScene(std::uint64_t seed) : random_(seed) {}

  csg::Scene make() {
    const bool is_drilled = random_() % 2 == 0;
    testing::SceneBuilder builder(is_drilled ? BooleanOp::kDifference
                                             : BooleanOp::kIntersection);
    if (is_drilled) add_large(builder, 3.6);
    const bool is_grouped = random_() % 2 == 0 || !is_drilled;
    if (is_grouped) builder.begin(BooleanOp::kUnion);
    const std::uint64_t count = 3 + random_() % 90;
    for (std::uint64_t i = 0; i < count; ++i) add_small(builder);
    if (is_grouped) builder.end();
    if (!is_drilled) {
      builder.begin(BooleanOp::kDifference);
      add_large(builder, 3.6);
      add_large(builder, 1.1);
      builder.end();
    }
    return builder.finish();
  }

 private:
  double unit() {
    return std::uniform_real_distribution<double>(0, 1)(random_);
  }
  Affine turn() {
    if (random_() % 2 == 0) return Affine(1.0);
    return testing::rotated(360 * unit(), {unit(), unit() - 0.5, 0.3});
  }
  // Around the origin.
  void add_large(testing::SceneBuilder& builder, double radius) {
    using namespace testing;
    const double low = -1.5 * radius;
    switch (random_() % 4) {
      case 0:
        return builder.add(sphere_leaf(radius, 16), turn());
      case 1:
        return builder.add(cylinder_leaf(radius, 0.8 * radius, -2 * low, 12),
                           translated({0, 0, low}));
      case 2:
        return builder.add(torus_leaf(0.7 * radius, 0.3 * radius, 12, 8),
                           turn());
      default:
        return builder.add(cube_leaf(Vec3(1.6 * radius)),
                           turn() * translated(Vec3(-0.8 * radius)));
    }
  }
  // On a lattice, so that some touch, or anywhere.
  void add_small(testing::SceneBuilder& builder) {
    using namespace testing;
    Vec3 place(0);
    for (int axis = 0; axis < 2; ++axis) place[axis] = 8 * unit() - 4;
    place.z = 1.2 * unit() - 0.6;
    if (random_() % 2 == 0) place = glm::round(2.0 * place) / 2.0;
    const double size = random_() % 3 == 0 ? 0.5 : 0.1 + 0.5 * unit();
    const Affine to_place = translated(place);
    switch (random_() % 5) {
      case 0:
        return builder.add(sphere_leaf(size / 2, 8), to_place);
      case 1:
        return builder.add(cylinder_leaf(size / 2, size / 2, 2 * size, 6),
                           to_place);
      case 2:
        return builder.add(as_mesh(cylinder_leaf(size / 2, 0, size, 5)),
                           to_place * turn());
      case 3:
        return builder.add(torus_leaf(size / 2, size / 6, 7, 4),
                           to_place * turn());
      default:
        return builder.add(cube_leaf(Vec3(size)), to_place * turn());
    }
  }

  std::mt19937_64 random_;
};

TEST(RandomScenes, ScatteredLeavesAreWhatTheyAreAmongOthers) {
  const std::uint64_t count = number_from("LAMINA_RANDOM_SCENES", 120);
  const std::uint64_t first_seed = number_from("LAMINA_RANDOM_SEED", 1);
  Tally tally;
  for (std::uint64_t seed = first_seed; seed < first_seed + count; ++seed) {
    // Of so many leaves some pass within a tie of others.
    SceneJudge(seed, SceneStyle::kDuplicate, 1, tally)
        .judge(ScatteredScene(seed).make(), 0);
    if (tally.failures > 20) break;
  }
  std::cout << tally.scenes << " scenes, " << tally.layers << " layers, "
            << tally.probes << " probes, " << tally.failures << " failures\n";
}

// Almost vertical faces that tie where they end: what passed for a steep
// face's rounding once hid that the boundary ran into itself.
TEST(RandomScenes, SteepFacesThatTieAtTheirEndsAreResolved) {
  Tally tally;
  for (const std::uint64_t seed : {777, 6003}) judge_seed(seed, tally);
  EXPECT_GT(tally.resolved_layers, 0U);
  EXPECT_EQ(tally.failures, 0U);
}

}  // namespace
}  // namespace lamina::plane
