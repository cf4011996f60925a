#include "plane/order/event_queue.h"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace lamina::plane {
namespace {

Certificate failing_at(double x) { return {1, x, kNever}; }
Certificate valid_until(double x) { return {1, kNever, x}; }

std::vector<std::uint32_t> renewals_of(EventQueue& queue) {
  std::vector<std::uint32_t> entries;
  queue.visit_renewals(
      [&](const PairRef& pair) { entries.push_back(pair.entry); });
  return entries;
}

TEST(EventQueue, GivesFailuresFromLeftToRight) {
  EventQueue queue;
  queue.begin(0, 10, 4);
  EXPECT_EQ(queue.next_failure(), kNever);
  const double places[] = {7, 2, 9, 1, 4};
  for (std::uint32_t i = 0; i < 5; ++i) {
    queue.schedule({i, 10 + i}, failing_at(places[i]));
  }
  for (const std::uint32_t entry : {3U, 1U, 4U, 0U, 2U}) {
    EXPECT_EQ(queue.next_failure(), places[entry]);
    const PairRef pair = queue.take_failure();
    EXPECT_EQ(pair.entry, entry);
    EXPECT_EQ(pair.stamp, 10 + entry);
  }
  EXPECT_EQ(queue.next_failure(), kNever);
}

TEST(EventQueue, DividesALayerIntoSlabsOfWhichTheLastHasNoEnd) {
  EventQueue queue;
  queue.begin(-2, 6, 4);
  for (const double start : {-2.0, 0.0, 2.0}) {
    EXPECT_EQ(queue.slab_start(), start);
    EXPECT_EQ(queue.slab_end(), start + 2);
    queue.enter_next_slab();
  }
  EXPECT_EQ(queue.slab(), 3U);
  EXPECT_EQ(queue.slab_end(), kNever);
}

TEST(EventQueue, RenewsACertificateInTheSlabInWhichItEnds) {
  EventQueue queue;
  queue.begin(0, 10, 5);
  queue.schedule({1, 0}, valid_until(4.5));
  queue.schedule({2, 0}, valid_until(9));
  queue.schedule({3, 0}, valid_until(5));
  EXPECT_EQ(queue.next_failure(), kNever);
  queue.enter_next_slab();
  EXPECT_EQ(renewals_of(queue), std::vector<std::uint32_t>{});
  queue.enter_next_slab();
  EXPECT_EQ(renewals_of(queue), (std::vector<std::uint32_t>{3, 1}));
}

// What fails right where a slab begins has to be seen before.
TEST(EventQueue, RenewsStrictlyBeforeACertificateEnds) {
  EventQueue queue;
  queue.begin(0, 10, 5);
  queue.schedule({1, 0}, valid_until(6));
  queue.enter_next_slab();
  queue.enter_next_slab();
  EXPECT_EQ(renewals_of(queue), std::vector<std::uint32_t>{1});
  EXPECT_LT(queue.slab_start(), 6);
}

TEST(EventQueue, NeverRenewsInThePresentSlabOrBehindTheLast) {
  EventQueue queue;
  queue.begin(0, 10, 2);
  queue.schedule({1, 0}, valid_until(1));
  queue.schedule({2, 0}, valid_until(kNever));
  EXPECT_EQ(renewals_of(queue), std::vector<std::uint32_t>{});
  queue.enter_next_slab();
  EXPECT_EQ(renewals_of(queue), std::vector<std::uint32_t>{1});
  queue.schedule({3, 0}, valid_until(9));
  EXPECT_EQ(renewals_of(queue), std::vector<std::uint32_t>{1});
}

}  // namespace
}  // namespace lamina::plane
