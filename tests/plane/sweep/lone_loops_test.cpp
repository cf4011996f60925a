#include "plane/sweep/lone_loops.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "csg/scene.h"
#include "plane/chain_builder.h"
#include "plane/chains.h"
#include "plane/program/program_states.h"
#include "plane/sweep/chain_endpoints.h"
#include "tests/ldni/support/scene_builder.h"
#include "tests/plane/sweep/loops.h"

namespace lamina::plane {
namespace {

Loop square(const Vec2& low, double size) {
  return {low, low + Vec2(size, 0), low + Vec2(size), low + Vec2(0, size)};
}

// A layer of one leaf.
class Layer {
 public:
  explicit Layer(const std::vector<Loop>& loops,
                 bool may_overlap_itself = false) {
    csg::Leaf leaf = testing::cube_leaf({1, 1, 1});
    leaf.may_overlap_itself = may_overlap_itself;
    testing::SceneBuilder scene;
    scene.add(leaf);
    const ProgramStates states(csg::program_of(scene.finish()),
                               FillRule::kNonZero);
    block.layer_count = 1;
    ChainBuilder builder;
    builder.begin(block);
    for (const Loop& loop : loops) {
      builder.loop() = loop;
      builder.close_loop(0, 0, 1);
    }
    builder.finish(block);
    lone_loops.find(block.chains_of(0), states);
  }

  // Of loops that have two chains each.
  std::vector<bool> are_lone() const {
    std::vector<bool> result;
    for (std::uint32_t i = 0; i < block.layer(0).size(); i += 2) {
      result.push_back(lone_loops.is_lone(i));
      EXPECT_EQ(lone_loops.is_lone(i + 1), lone_loops.is_lone(i));
    }
    return result;
  }

  ChainBlock block;
  LoneLoops lone_loops;
};

// Five loops far from each other.
std::vector<Loop> scattered() {
  std::vector<Loop> loops;
  for (int i = 0; i < 5; ++i) loops.push_back(diamond({10.0 * i, 0.1 * i}, 1));
  return loops;
}

TEST(LoneLoops, AreConvexLoopsFarFromAllOthers) {
  const Layer layer(scattered());
  EXPECT_EQ(layer.are_lone(), std::vector<bool>(5, true));
  for (std::uint32_t i = 0; i < 10; ++i) {
    const Chain& chain = layer.block.layer(0)[i];
    EXPECT_EQ(layer.lone_loops.is_lower(i), chain.winding > 0);
  }
}

TEST(LoneLoops, AreNotThoseWithOthersInTheirBox) {
  std::vector<Loop> loops = scattered();
  loops.push_back(diamond({10.9, 0.9}, 0.3));  // beside the second one
  loops.push_back(diamond({30, 0.3}, 0.2));    // inside the fourth one
  const Layer layer(loops);
  EXPECT_EQ(layer.are_lone(),
            (std::vector<bool>{true, false, true, false, true, false, false}));
}

TEST(LoneLoops, AreNotThoseThatAVerticalEdgePasses) {
  std::vector<Loop> loops = scattered();
  loops.push_back(square({20.5, -30}, 60));  // its left wall cuts the third one
  const Layer layer(loops);
  EXPECT_TRUE(layer.lone_loops.is_lone(0));
  EXPECT_FALSE(layer.lone_loops.is_lone(4));
}

TEST(LoneLoops, AreNotThoseOfLeavesThatMayOverlapThemselves) {
  const Layer layer(scattered(), true);
  EXPECT_EQ(layer.are_lone(), std::vector<bool>(5, false));
}

TEST(LoneLoops, AreNotThoseThatAreNotConvex) {
  std::vector<Loop> loops = scattered();
  loops[2] = {{19, 0}, {20, 0.5}, {21, 0}, {20, 2}};
  const Layer layer(loops);
  EXPECT_EQ(layer.are_lone(),
            (std::vector<bool>{true, true, false, true, true}));
}

// --- Against the definition -------------------------------------------------

bool boxes_meet(const Loop& a, const Loop& b) {
  for (int axis = 0; axis < 2; ++axis) {
    const auto less = [axis](const Vec2& p, const Vec2& q) {
      return p[axis] < q[axis];
    };
    const auto [a_low, a_high] = std::minmax_element(a.begin(), a.end(), less);
    const auto [b_low, b_high] = std::minmax_element(b.begin(), b.end(), less);
    if ((*a_high)[axis] < (*b_low)[axis]) return false;
    if ((*b_high)[axis] < (*a_low)[axis]) return false;
  }
  return true;
}

// Around a diamond no other one may come into its box, so no other box may
// hold it or meet it with an edge.
TEST(LoneLoops, OfRandomDiamondsHaveTheirBoxToThemselves) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  int lone = 0;
  int others = 0;
  for (int round = 0; round < 200; ++round) {
    std::vector<Loop> loops;
    for (int i = 0; i < 30; ++i) {
      loops.push_back(diamond(Vec2(40 * unit(random), 40 * unit(random)),
                              0.2 + 2 * unit(random)));
    }
    const std::vector<bool> are_lone = Layer(loops).are_lone();
    ASSERT_EQ(are_lone.size(), loops.size());
    for (std::size_t i = 0; i < loops.size(); ++i) {
      ++(are_lone[i] ? lone : others);
      if (!are_lone[i]) continue;
      for (std::size_t k = 0; k < loops.size(); ++k) {
        if (k == i || !are_lone[k]) continue;
        EXPECT_FALSE(boxes_meet(loops[i], loops[k])) << round;
      }
      for (const Vec2& point : loops[i]) {
        for (std::size_t k = 0; k < loops.size(); ++k) {
          if (k == i) continue;
          // Inside another diamond's edges only with all four points.
          const Vec2 centre = 0.5 * (loops[k][0] + loops[k][2]);
          const double radius = loops[k][2].x - centre.x;
          const auto depth = [&](const Vec2& p) {
            return std::abs(p.x - centre.x) + std::abs(p.y - centre.y) - radius;
          };
          EXPECT_EQ(depth(point) < 0, depth(loops[i][0]) < 0) << round;
        }
      }
    }
  }
  EXPECT_GT(lone, 500);
  EXPECT_GT(others, 500);
}

// --- The endpoints of chains ------------------------------------------------

// On a lattice of 64 places, so that many have one x.
TEST(EndpointSorter, SortsByXThenByChain) {
  for (const int count : {3, 60, 500, 5000}) {
    std::mt19937_64 random(7);
    std::vector<Loop> loops;
    for (int i = 0; i < count; ++i) {
      const auto x = static_cast<double>(random() % 64);
      loops.push_back(diamond({x, 3.0 * i}, 1));
    }
    const Layer layer(loops, true);
    EndpointSorter sorter;
    const auto endpoints =
        sorter.sort(layer.block.layer(0), layer.block.points, layer.lone_loops);
    ASSERT_EQ(endpoints.size(), 2 * layer.block.layer(0).size());
    for (std::size_t i = 0; i < endpoints.size(); ++i) {
      const ChainEndpoint& here = endpoints[i];
      const auto points =
          layer.block.layer(0)[here.chain()].points_in(layer.block.points);
      EXPECT_EQ(here.x, here.is_right() ? points.back().x : points.front().x);
      if (i == 0) continue;
      const ChainEndpoint& before = endpoints[i - 1];
      EXPECT_TRUE(
          before.x < here.x ||
          (before.x == here.x && before.chain_and_side < here.chain_and_side));
    }
  }
}

TEST(EndpointSorter, ListsOfALoneLoopItsLeftEndpointOnly) {
  const Layer layer(scattered());
  EndpointSorter sorter;
  const auto endpoints =
      sorter.sort(layer.block.layer(0), layer.block.points, layer.lone_loops);
  ASSERT_EQ(endpoints.size(), 5U);
  for (std::uint32_t i = 0; i < 5; ++i) {
    EXPECT_EQ(endpoints[i].chain(), 2 * i);
    EXPECT_FALSE(endpoints[i].is_right());
    EXPECT_EQ(endpoints[i].x, 10.0 * i - 1);
  }
}

}  // namespace
}  // namespace lamina::plane
