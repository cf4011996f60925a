#include "plane/cascade/chain_clipper.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "csg/scene.h"
#include "ldni/section/grid.h"
#include "ldni/section/leaf_section.h"
#include "plane/chain_builder.h"
#include "plane/tie_distance.h"
#include "tests/ldni/support/scene_builder.h"
#include "tests/plane/cascade/swept.h"
#include "tests/support/contour_checks.h"

namespace lamina::plane {
namespace {

using support::LoopCounts;
using testing::kPatient;
using testing::SceneBuilder;
using testing::Swept;
using testing::operator*;

// The layer of a scene at height 0.5, and what is made of it.
class ClippedLayer {
 public:
  explicit ClippedLayer(csg::Scene scene) : scene_(std::move(scene)) {
    const ldni::LayerGrid grid = ldni::LayerGrid::at_heights({0.5});
    ldni::LeafSectioner(scene_, grid).cut(0, 1, block_);
    clipper_.begin(block_.chains_of(0));
    clipped_ = clipper_.clip();
  }

  LayerChains whole() const { return block_.chains_of(0); }
  const LayerChains& clipped() const { return clipped_; }
  double share_within() const { return clipper_.share_within(); }

  Swept sweep(const LayerChains& layer, double patience = kPatient) const {
    return testing::sweep(scene_, {&layer, 1}, patience);
  }

 private:
  csg::Scene scene_;
  BooleanProgram program_ = csg::program_of(scene_);
  ldni::SectionBlock block_;
  ChainClipper clipper_{program_};
  LayerChains clipped_;
};

// The chains of each leaf begin and end in pairs, at one x, and sum up to
// nothing.
void expect_closed(const LayerChains& layer) {
  std::map<std::uint32_t, std::map<double, int>> ends;
  std::uint32_t chain_count = 0;
  for (const ChainLoop& loop : layer.loops) chain_count += loop.chain_count;
  EXPECT_EQ(chain_count, layer.chains.size());
  for (const Chain& chain : layer.chains) {
    const auto points = chain.points_in(layer.points);
    for (std::size_t i = 1; i < points.size(); ++i) {
      EXPECT_GT(points[i].x - points[i - 1].x, kClusterWidth);
    }
    ends[chain.operand][points.front().x] += chain.winding;
    ends[chain.operand][points.back().x] -= chain.winding;
  }
  for (const auto& [instance, changes] : ends) {
    for (const auto& [x, change] : changes) {
      EXPECT_EQ(change, 0) << "leaf " << instance << " at " << x;
    }
  }
}

std::set<std::pair<double, double>> points_of(const Contours& contours) {
  std::set<std::pair<double, double>> points;
  for (const Vec2& point : contours.points) points.emplace(point.x, point.y);
  return points;
}

// Whether each point of one has a point of the other within 1e-9 mm.
void expect_same_points(const Contours& a, const Contours& b) {
  ASSERT_EQ(a.points.size(), b.points.size());
  const auto points = points_of(b);
  for (const Vec2& point : a.points) {
    bool is_there = false;
    for (auto it = points.lower_bound({point.x - 1e-9, -1e300});
         it != points.end() && it->first < point.x + 1e-9; ++it) {
      is_there = is_there || std::abs(it->second - point.y) < 1e-9;
    }
    EXPECT_TRUE(is_there) << point.x << ' ' << point.y;
  }
}

void expect_same_region(const ClippedLayer& layer) {
  expect_closed(layer.clipped());
  const Swept whole = layer.sweep(layer.whole());
  const Swept clipped = layer.sweep(layer.clipped());
  for (const auto& defect : support::find_defects(clipped.layers[0])) {
    ADD_FAILURE() << defect.message;
  }
  EXPECT_EQ(support::count_loops(clipped.layers[0]),
            support::count_loops(whole.layers[0]));
  EXPECT_NEAR(support::total_area(clipped.layers[0]),
              support::total_area(whole.layers[0]), 1e-9);
  expect_same_points(clipped.layers[0], whole.layers[0]);
  EXPECT_EQ(clipped.counts.unbalanced_clusters, 0U);
  EXPECT_EQ(clipped.counts.repaired_clusters, 0U);
  EXPECT_EQ(clipped.counts.capped_clusters, 0U);
}

// A bar along x, turned.
void add_bar(SceneBuilder& builder, double angle, const Vec2& centre,
             double length, double width) {
  builder.add(testing::cube_leaf({length, width, 1}),
              testing::translated({centre.x, centre.y, 0}) *
                  testing::rotated(angle, {0, 0, 1}) *
                  testing::translated({-length / 2, -width / 2, 0}));
}

// Plates side by side, each of them drilled by bars that reach through all.
csg::Scene drilled_plates(int count) {
  SceneBuilder builder;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < count; ++i) {
    const Vec2 centre(12.0 * (i % 4), 12.0 * (i / 4));
    builder.begin(BooleanOp::kDifference);
    add_bar(builder, 0, centre, 10, 10);
    for (int k = 0; k < 5; ++k) {
      add_bar(builder, 180 * unit(random),
              centre + Vec2(8 * unit(random) - 4, 8 * unit(random) - 4), 200,
              0.1);
    }
    builder.end();
  }
  return builder.finish();
}

// Teeth of a gear that a box cuts to a part of it.
csg::Scene gear_in_box(const Vec2& size) {
  std::vector<Vec2> outline;
  for (int i = 0; i < 200; ++i) {
    const double angle = 0.0314159 * i;
    outline.push_back((i % 2 == 0 ? 10.0 : 8.0) *
                      Vec2(std::cos(angle), std::sin(angle)));
  }
  SceneBuilder builder(BooleanOp::kIntersection);
  builder.add(testing::extrusion_leaf(outline, 1));
  builder.add(testing::cube_leaf({size.x, size.y, 1}),
              testing::translated({1, 2, 0}));
  return builder.finish();
}

TEST(ChainClipper, ChangesNoRegion) {
  expect_same_region(ClippedLayer(drilled_plates(12)));
  for (const Vec2& size :
       {Vec2(3, 3), Vec2(30, 3), Vec2(3, 30), Vec2(30, 30), Vec2(7.5, 6.5)}) {
    expect_same_region(ClippedLayer(gear_in_box(size)));
  }
}

TEST(ChainClipper, ClipsShiftedAndTurnedScenesAlike) {
  for (const double angle : {0.0, 0.01, 30.0, 90.0, 137.0}) {
    for (const double shift : {0.0, 1e3}) {
      csg::Scene scene = drilled_plates(8);
      const Affine placement = testing::translated({shift, -shift / 3, 0}) *
                               testing::rotated(angle, {0, 0, 1});
      for (csg::Instance& instance : scene.instances) {
        instance.world_from_leaf = placement * instance.world_from_leaf;
        instance.box = {{-1e5, -1e5, 0}, {1e5, 1e5, 1}};
      }
      scene.box = {{-1e5, -1e5, 0}, {1e5, 1e5, 1}};
      expect_same_region(ClippedLayer(scene));
    }
  }
}

TEST(ChainClipper, LeavesOutWhatIsBesideTheZone) {
  const ClippedLayer layer(drilled_plates(16));
  EXPECT_LT(layer.share_within(), 0.5);
  const auto events = [&](const LayerChains& chains, double patience) {
    return layer.sweep(chains, patience).counts.event_points;
  };
  EXPECT_LT(5 * events(layer.clipped(), kPatient),
            events(layer.whole(), kPatient));
  EXPECT_LT(2 * events(layer.whole(), 1), events(layer.whole(), kPatient));
}

TEST(ChainClipper, SumsUpWhatLiesAlongASide) {
  // Of 200 flanks of the gear 100 lie above or below the box.
  const ClippedLayer layer(gear_in_box({30, 1}));
  EXPECT_GT(layer.whole().chains.size(), 100U);
  EXPECT_LT(layer.clipped().chains.size(), 20U);
}

TEST(ChainClipper, KeepsWhatLiesInTheZonePointForPoint) {
  SceneBuilder builder(BooleanOp::kDifference);
  builder.add(testing::cylinder_leaf(5, 5, 1, 60));
  for (int i = 0; i < 5; ++i) {
    builder.add(testing::cylinder_leaf(0.5, 0.5, 1, 12),
                testing::translated({i - 2.0, 0.3, 0}));
  }
  const ClippedLayer layer(builder.finish());
  EXPECT_EQ(layer.share_within(), 1);
  const LayerChains whole = layer.whole();
  const LayerChains& clipped = layer.clipped();
  ASSERT_EQ(clipped.chains.size(), whole.chains.size());
  EXPECT_TRUE(std::ranges::equal(clipped.loops, whole.loops));
  for (std::size_t i = 0; i < whole.chains.size(); ++i) {
    EXPECT_TRUE(std::ranges::equal(clipped.chains[i].points_in(clipped.points),
                                   whole.chains[i].points_in(whole.points)));
  }
}

TEST(ChainClipper, LeavesOutLeavesOfAnIntersectionThatIsEmpty) {
  SceneBuilder builder(BooleanOp::kIntersection);
  add_bar(builder, 10, {0, 0}, 5, 1);
  add_bar(builder, 20, {20, 0}, 5, 1);
  csg::Scene scene = builder.finish();
  scene.box = {{-50, -50, 0}, {50, 50, 1}};
  for (csg::Instance& instance : scene.instances) instance.box = scene.box;
  EXPECT_TRUE(ClippedLayer(scene).clipped().chains.empty());
}

}  // namespace
}  // namespace lamina::plane
