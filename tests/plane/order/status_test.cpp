#include "plane/order/status.h"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace lamina::plane {
namespace {

// Level chains from x = 0 to 1, one at each height, as entries in that order.
class LevelChains {
 public:
  explicit LevelChains(const std::vector<double>& heights) {
    status.begin(heights.size());
    for (const double y : heights) chains_.push_back({{0, y}, {1, y}});
    std::uint32_t below = status.sentinel();
    for (std::uint32_t i = 0; i < heights.size(); ++i) {
      insert_above(below, i);
      below = i;
    }
  }

  void insert_above(std::uint32_t below, std::uint32_t entry) {
    status[entry] = {};
    status[entry].cursor =
        ChainCursor(&chains_[entry].front(), &chains_[entry].back());
    status.insert_above(below, entry);
  }

  Status status;

 private:
  std::vector<std::vector<Vec2>> chains_;
};

using Numbers = std::vector<std::uint32_t>;

// Entries upwards; the way down must be the same.
Numbers order_of(const Status& status) {
  Numbers up;
  for (std::uint32_t e = status.first(); e != status.sentinel();
       e = status[e].above) {
    up.push_back(e);
    EXPECT_EQ(status[status[e].above].below, e);
    EXPECT_TRUE(status.is_alive(e));
  }
  return up;
}

TEST(Status, IsEmptyAtTheBeginningOfALayer) {
  LevelChains chains({0, 1});
  chains.status.begin(5);
  EXPECT_EQ(order_of(chains.status), Numbers{});
  EXPECT_FALSE(chains.status.is_alive(0));
  EXPECT_EQ(chains.status.find_below(0, 0), chains.status.sentinel());
}

TEST(Status, InsertsRemovesAndSwapsNeighbours) {
  LevelChains chains({0, 1, 2, 3});
  Status& status = chains.status;
  EXPECT_EQ(order_of(status), (Numbers{0, 1, 2, 3}));
  status.remove(1);
  EXPECT_EQ(order_of(status), (Numbers{0, 2, 3}));
  EXPECT_FALSE(status.is_alive(1));
  status.swap_with_above(0);
  EXPECT_EQ(order_of(status), (Numbers{2, 0, 3}));
  chains.insert_above(3, 1);
  EXPECT_EQ(order_of(status), (Numbers{2, 0, 3, 1}));
  chains.status.remove(2);
  EXPECT_EQ(status.first(), 0U);
}

TEST(Status, FindsTheGapOfAPlace) {
  LevelChains chains({0, 1, 2});
  Status& status = chains.status;
  EXPECT_EQ(status.find_below(-0.5, 0.5), status.sentinel());
  EXPECT_EQ(status.find_below(0.5, 0.5), 0U);
  EXPECT_EQ(status.find_below(1, 0.5), 1U);
  EXPECT_EQ(status.find_below(7, 0.5), 2U);
}

TEST(Status, FindsGapsWhileEntriesComeAndGo) {
  std::vector<double> heights(200);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    heights[i] = static_cast<double>(i);
  }
  LevelChains chains(heights);
  Status& status = chains.status;
  // Every entry but each seventh leaves, in a scattered order.
  for (std::uint32_t i = 0; i < 200; ++i) {
    const std::uint32_t entry = i * 71 % 200;
    if (entry % 7 == 0) continue;
    status.remove(entry);
    const std::uint32_t place = i * 37 % 200;
    std::uint32_t below = place;
    while (!status.is_alive(below)) --below;
    EXPECT_EQ(status.find_below(place + 0.5, 0.5), below);
  }
}

}  // namespace
}  // namespace lamina::plane
