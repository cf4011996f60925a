#include "plane/order/ray_order.h"

#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace lamina::plane {
namespace {

using Polyline = std::vector<Vec2>;
using Numbers = std::vector<std::uint32_t>;

constexpr double kTie = 1e-6;

// Chains from x = 0 to 8 that begin in one cluster.
class BegunOrder {
 public:
  explicit BegunOrder(std::vector<Polyline> chains)
      : order(kTie), chains_(std::move(chains)) {
    order.begin_layer(chains_.size(), 0, 8, 4);
    order.begin_cluster(0);
    order.take_endpoint(0);
    for (std::uint32_t i = 0; i < chains_.size(); ++i) {
      order.insert(i, chains_[i], 0);
    }
    order.settle();
  }

  Numbers entries() {
    Numbers up;
    for (std::uint32_t e = order.status().first();
         e != order.status().sentinel(); e = order.status()[e].above) {
      up.push_back(e);
    }
    return up;
  }
  // Goes to the next event point and returns its x.
  double advance() {
    const double x = order.next_event_point(8);
    order.begin_cluster(x);
    order.settle();
    return x;
  }

  RayOrder order;

 private:
  std::vector<Polyline> chains_;
};

TEST(RayOrder, PutsChainsThatBeginTogetherInTheOrderInWhichTheyGoOn) {
  BegunOrder begun({{{0, 0}, {8, 5}}, {{0, 0}, {8, -5}}, {{0, 0}, {8, 1}}});
  EXPECT_EQ(begun.entries(), (Numbers{1, 2, 0}));
}

// Loops in loops begin from the outermost on, each in the middle of all others.
TEST(RayOrder, WalksNoFurtherAmongThousandsOfLoopsInLoops) {
  constexpr std::uint32_t kLoops = 5000;
  std::vector<Polyline> chains;
  for (std::uint32_t i = 0; i < kLoops; ++i) {
    chains.push_back({{i, 0}, {2 * kLoops, -2.0 * kLoops + i}});
    chains.push_back({{i, 0}, {2 * kLoops, 2.0 * kLoops - i}});
  }
  RayOrder order(kTie);
  order.begin_layer(chains.size(), 0, 2 * kLoops, 4);
  for (std::uint32_t i = 0; i < kLoops; ++i) {
    order.begin_cluster(i);
    order.take_endpoint(i);
    order.insert(2 * i, chains[2 * i], 0);
    order.insert(2 * i + 1, chains[2 * i + 1], 0);
    order.settle();
  }
  EXPECT_EQ(order.status().long_walks(), 0U);
  EXPECT_EQ(order.status().first(), 0U);
  EXPECT_EQ(order.swaps(), 0U);
}

TEST(RayOrder, SwapsChainsWhereTheyCross) {
  BegunOrder begun({{{0, 0}, {8, 8}}, {{0, 2}, {8, 2}}, {{0, 6}, {8, 6}}});
  EXPECT_EQ(begun.entries(), (Numbers{0, 1, 2}));
  EXPECT_EQ(begun.advance(), 2);
  EXPECT_EQ(begun.entries(), (Numbers{1, 0, 2}));
  EXPECT_EQ(begun.advance(), 6);
  EXPECT_EQ(begun.entries(), (Numbers{1, 2, 0}));
  EXPECT_EQ(begun.order.next_event_point(8), 8);
}

TEST(RayOrder, TurnsABundleThatCrossesInOnePointInOneCluster) {
  BegunOrder begun({{{0, 0}, {8, 8}},
                    {{0, 2}, {8, 6}},
                    {{0, 4}, {8, 4}},
                    {{0, 6}, {8, 2}},
                    {{0, 8}, {8, 0}}});
  EXPECT_EQ(begun.entries(), (Numbers{0, 1, 2, 3, 4}));
  EXPECT_EQ(begun.advance(), 4);
  EXPECT_EQ(begun.entries(), (Numbers{4, 3, 2, 1, 0}));
  EXPECT_EQ(begun.order.next_event_point(8), 8);
}

TEST(RayOrder, TiesChainsWhileTheyCoincide) {
  BegunOrder begun({{{0, 0}, {2, 1}, {6, 1}, {8, 0}},
                    {{0, 2}, {2, 1 + 1e-9}, {6, 1 + 1e-9}, {8, 2}}});
  Status& status = begun.order.status();
  EXPECT_FALSE(status[0].is_tied);
  EXPECT_EQ(begun.advance(), 2);
  EXPECT_TRUE(status[0].is_tied);
  EXPECT_EQ(begun.advance(), 6);
  EXPECT_FALSE(status[0].is_tied);
}

TEST(RayOrder, ReportsWhatAClusterChanged) {
  BegunOrder begun({{{0, 0}, {8, 8}}, {{0, 2}, {8, 2}}, {{0, 6}, {8, 6}}});
  begun.advance();
  const OrderChanges& changes = begun.order.changes();
  EXPECT_EQ(changes.stale, (Numbers{0, 1}));
  EXPECT_EQ(changes.touches, (Numbers{0}));
  EXPECT_EQ(begun.order.cluster().number, 2U);
  EXPECT_EQ(begun.order.cluster().left, 2);
  EXPECT_EQ(begun.order.cluster().right, 2);
}

TEST(RayOrder, CertifiesTheNeighboursOfAChainThatEnds) {
  BegunOrder begun({{{0, 0}, {8, 8}}, {{0, 3}, {1, 3}}, {{0, 6}, {8, 6}}});
  const double end = begun.order.next_event_point(1);
  EXPECT_EQ(end, 1);
  begun.order.begin_cluster(end);
  begun.order.take_endpoint(end);
  begun.order.remove(1);
  begun.order.settle();
  EXPECT_EQ(begun.entries(), (Numbers{0, 2}));
  EXPECT_EQ(begun.advance(), 6);
  EXPECT_EQ(begun.entries(), (Numbers{2, 0}));
}

}  // namespace
}  // namespace lamina::plane
