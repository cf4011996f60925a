#include "plane/sweep/sweep_trace.h"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "plane/chain_builder.h"
#include "tests/plane/sweep/loops.h"

namespace lamina::plane {
namespace {

using Chains = std::vector<std::uint32_t>;

// The union of loops, each an operand of its own. Chain 2i is the upper one of
// loop i, chain 2i + 1 the lower one.
SweepTrace trace_of(const std::vector<Loop>& loops) {
  ChainBlock block;
  block.layer_count = 1;
  ChainBuilder builder;
  builder.begin(block);
  for (std::uint32_t i = 0; i < loops.size(); ++i) {
    builder.loop() = loops[i];
    builder.close_loop(0, i, 1);
  }
  builder.finish(block);
  return trace_sweep(
      block.chains_of(0),
      program_of(BooleanOp::kUnion, static_cast<std::uint32_t>(loops.size())));
}

Chains chains_of(const std::vector<TracedEntry>& entries) {
  Chains chains;
  for (const TracedEntry& entry : entries) chains.push_back(entry.chain);
  return chains;
}

TEST(SweepTrace, FollowsTwoDiamondsThatCross) {
  const SweepTrace trace = trace_of({diamond({0, 0}, 2), diamond({2, 0}, 2)});
  ASSERT_EQ(trace.events.size(), 5U);
  EXPECT_TRUE(trace.passed.empty());
  const std::vector<double> places = {-2, 0, 1, 2, 4};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(trace.events[i].left, places[i], 1e-9);
  }
  EXPECT_EQ(trace.events[0].begun, (Chains{1, 0}));
  EXPECT_EQ(chains_of(trace.events[0].arcs_begun), (Chains{1, 0}));
  EXPECT_EQ(trace.events[0].arcs_begun[0].side, 1);
  EXPECT_EQ(trace.events[0].arcs_begun[1].side, -1);

  // The second one begins within the first: no boundary.
  EXPECT_EQ(trace.events[1].begun, (Chains{3, 2}));
  EXPECT_TRUE(trace.events[1].arcs_begun.empty());

  const TracedEvent& crossing = trace.events[2];
  EXPECT_EQ(crossing.swapped, (Chains{3, 1, 0, 2}));
  EXPECT_EQ(chains_of(crossing.arcs_ended), (Chains{1, 0}));
  EXPECT_EQ(chains_of(crossing.arcs_begun), (Chains{3, 2}));
  EXPECT_EQ(chains_of(crossing.ray), (Chains{3, 1, 0, 2}));
  EXPECT_FALSE(crossing.has_more_below);
  EXPECT_FALSE(crossing.has_more_above);

  EXPECT_EQ(trace.events[3].ended, (Chains{1, 0}));
  EXPECT_EQ(trace.events[4].ended, (Chains{3, 2}));
  EXPECT_EQ(chains_of(trace.events[4].arcs_ended), (Chains{3, 2}));
}

TEST(SweepTrace, ShowsTiesWhereSquaresTouch) {
  const SweepTrace trace = trace_of({{{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                                     {{0.5, 1}, {1.5, 1}, {1.5, 2}, {0.5, 2}}});
  ASSERT_EQ(trace.events.size(), 4U);
  const TracedEvent& meeting = trace.events[1];
  ASSERT_EQ(meeting.tied.size(), 1U);
  EXPECT_EQ(meeting.tied[0].lower + meeting.tied[0].upper, 3U);
  EXPECT_EQ(chains_of(meeting.arcs_ended), (Chains{0}));
  EXPECT_EQ(chains_of(meeting.arcs_begun), (Chains{2}));
  EXPECT_EQ(trace.events[2].parted, meeting.tied);
  EXPECT_EQ(trace.events[2].ended, (Chains{1, 0}));
}

TEST(SweepTrace, PassesLoopsThatMeetNothing) {
  std::vector<Loop> loops;
  for (int i = 0; i < 64; ++i) {
    loops.push_back(diamond({3.0 * (i % 8), 3.0 * (i / 8)}, 1));
  }
  const SweepTrace trace = trace_of(loops);
  EXPECT_TRUE(trace.events.empty());
  EXPECT_EQ(trace.passed.size(), 128U);
}

TEST(SweepTrace, ShowsOnlyThePartOfTheRayThatChanges) {
  std::vector<Loop> loops;
  for (int i = 0; i < 9; ++i) {
    const double y = 3 * i;
    loops.push_back({{0, y}, {9, y}, {9, y + 2}, {0, y + 2}});
  }
  loops.push_back(diamond({5, 13}, 1.5));  // crosses the fifth
  for (const TracedEvent& event : trace_of(loops).events) {
    if (event.left < 3 || event.left > 7) continue;
    EXPECT_LE(event.ray.size(), 6U);
    EXPECT_TRUE(event.has_more_below);
    EXPECT_TRUE(event.has_more_above);
  }
}

}  // namespace
}  // namespace lamina::plane
