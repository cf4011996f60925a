#include "plane/order/order_tree.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace lamina::plane {
namespace {

// A tree beside a row that is known to be right.
class TreeAndRow {
 public:
  // `count` entries, none of them in the tree.
  explicit TreeAndRow(std::uint32_t count) : none_(count) {
    tree_.begin(count + 1);
  }

  std::size_t size() const { return row_.size(); }
  // At the place in the row.
  void insert(std::size_t place, std::uint32_t entry) {
    tree_.insert(place > 0 ? row_[place - 1] : none_,
                 place < row_.size() ? row_[place] : none_, entry);
    row_.insert(row_.begin() + static_cast<std::ptrdiff_t>(place), entry);
  }
  std::uint32_t remove(std::size_t place) {
    const std::uint32_t entry = row_[place];
    tree_.remove(entry, place + 1 < row_.size() ? row_[place + 1] : none_);
    row_.erase(row_.begin() + static_cast<std::ptrdiff_t>(place));
    EXPECT_FALSE(tree_.holds(entry));
    return entry;
  }
  void swap_with_next(std::size_t place) {
    tree_.swap(row_[place], row_[place + 1]);
    std::swap(row_[place], row_[place + 1]);
  }

  // Looks for all places; the most entries that were asked for one.
  int check() const {
    std::vector<std::size_t> places(none_ + 1);
    for (std::size_t i = 0; i < row_.size(); ++i) {
      places[row_[i]] = i;
      EXPECT_TRUE(tree_.holds(row_[i]));
    }
    int most = 0;
    for (std::size_t i = 0; i <= row_.size(); ++i) {
      int asked = 0;
      const auto is_before = [&](std::uint32_t entry) {
        ++asked;
        return places[entry] < i;
      };
      EXPECT_EQ(tree_.find_last(is_before, none_), i > 0 ? row_[i - 1] : none_);
      most = std::max(most, asked);
    }
    for (std::size_t i = 1; i < row_.size(); ++i) {
      EXPECT_LT(tree_.place_of(row_[i - 1]), tree_.place_of(row_[i]));
    }
    return most;
  }

 private:
  OrderTree tree_;
  std::vector<std::uint32_t> row_;
  std::uint32_t none_;
};

TEST(OrderTree, KeepsTheOrderWhileEntriesComeGoAndChangePlaces) {
  constexpr std::uint32_t kCount = 300;
  TreeAndRow both(kCount);
  std::vector<std::uint32_t> others(kCount);
  for (std::uint32_t i = 0; i < kCount; ++i) others[i] = i;
  std::mt19937 random(1);
  for (int step = 0; step < 20000; ++step) {
    // Grows and shrinks by turns.
    const std::uint32_t act = random() % 8;
    const bool grows = step / 1000 % 2 == 0;
    if (act < (grows ? 4U : 2U) && !others.empty()) {
      both.insert(random() % (both.size() + 1), others.back());
      others.pop_back();
    } else if (act < 6 && both.size() > 0) {
      others.push_back(both.remove(random() % both.size()));
    } else if (both.size() > 1) {
      both.swap_with_next(random() % (both.size() - 1));
    }
    if (step % 100 == 0) both.check();
  }
  while (both.size() > 0) both.remove(both.size() / 2);
  both.check();
}

// Trees of Adelson-Velsky and Landis are at most 1.45 log2(n) high.
TEST(OrderTree, AsksFewEntriesInWhateverOrderOthersCame) {
  constexpr std::uint32_t kCount = 4096;
  constexpr int kMostAsked = 17;
  for (const std::uint32_t parts : {0U, 1U, 2U, 3U}) {
    TreeAndRow both(kCount);
    // At the lower end, a third, two thirds, and the upper end.
    for (std::uint32_t i = 0; i < kCount; ++i) both.insert(i * parts / 3, i);
    EXPECT_LE(both.check(), kMostAsked);
    // All but a few leave from one side.
    while (both.size() > 16) both.remove(both.size() * parts / 4);
    EXPECT_LE(both.check(), 6);
  }
}

}  // namespace
}  // namespace lamina::plane
