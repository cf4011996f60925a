#include "plane/sweep/stitcher.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "plane/contours.h"
#include "plane/loop_area.h"

namespace lamina::plane {
namespace {

constexpr double kTie = 1e-6;
constexpr double kMerge = 1e-9;

// A chain that is boundary from its first point to its last one.
struct BoundaryChain {
  std::vector<Vec2> points;
  std::int8_t side = 1;  // +1: solid above
  std::uint32_t arc = 0;
};

// Starts and ends the arcs of chains whose endpoints have one of the places,
// event point by event point, lower chains first.
Contours stitched(std::vector<BoundaryChain> chains,
                  const std::vector<double>& places) {
  Stitcher stitcher({.tie_distance = kTie, .merge_distance = kMerge});
  stitcher.begin();
  for (const double x : places) {
    for (BoundaryChain& chain : chains) {
      const std::vector<Vec2>& points = chain.points;
      if (points.back().x == x) {
        stitcher.end_arc(chain.arc, points.back(), points.back().y,
                         &points[points.size() - 2]);
      }
      if (points.front().x == x) {
        chain.arc = stitcher.start_arc(points.front(), points.front().y,
                                       &points.front(), chain.side);
      }
    }
    stitcher.link_ends();
  }
  EXPECT_EQ(stitcher.unlinked_ends(), 0U);
  Contours contours;
  stitcher.write_loops(contours);
  return contours;
}

TEST(Stitcher, MakesALoopOfTwoArcsAndTwoWalls) {
  const Contours contours = stitched(
      {{{{0, 0}, {1, -1}, {2, 0}}, 1}, {{{0, 3}, {2, 3}}, -1}}, {0, 2});
  ASSERT_EQ(contours.loop_count(), 1U);
  EXPECT_EQ(contours.points,
            (std::vector<Vec2>{{0, 0}, {1, -1}, {2, 0}, {2, 3}, {0, 3}}));
}

TEST(Stitcher, TurnsHolesClockwise) {
  const Contours contours = stitched({{{{0, 0}, {8, 0}}, 1},
                                      {{{2, 2}, {4, 2}}, -1},
                                      {{{2, 4}, {4, 4}}, 1},
                                      {{{0, 8}, {8, 8}}, -1}},
                                     {0, 2, 4, 8});
  ASSERT_EQ(contours.loop_count(), 2U);
  EXPECT_EQ(signed_area(contours.loop(0)), 64);
  EXPECT_EQ(signed_area(contours.loop(1)), -4);
}

// What ends below a wall and what begins above it: an L.
TEST(Stitcher, LinksAnEndToABeginning) {
  const Contours contours = stitched(
      {{{{0, 0}, {4, 0}}, 1}, {{{2, 2}, {4, 2}}, -1}, {{{0, 6}, {2, 6}}, -1}},
      {0, 2, 4});
  ASSERT_EQ(contours.loop_count(), 1U);
  EXPECT_EQ(signed_area(contours.loop(0)), 4 * 2 + 2 * 4);
}

TEST(Stitcher, MakesTwoLoopsOfSquaresThatTouchInAPoint) {
  const Contours contours = stitched({{{{0, 0}, {2, 0}}, 1},
                                      {{{0, 2}, {2, 2}}, -1},
                                      {{{2, 2}, {4, 2}}, 1},
                                      {{{2, 4}, {4, 4}}, -1}},
                                     {0, 2, 4});
  ASSERT_EQ(contours.loop_count(), 2U);
  EXPECT_EQ(signed_area(contours.loop(0)), 4);
  EXPECT_EQ(signed_area(contours.loop(1)), 4);
}

// Squares to the left and to the right of one x, in turn: each touches the next
// one in a corner there. All their ends are those of one event point.
TEST(Stitcher, MakesALoopOfEachOfManySquaresThatTouchAtOneX) {
  for (const int count : {2, 3, 10, 100, 20'000}) {
    std::vector<BoundaryChain> chains;
    for (int i = 0; i < count; ++i) {
      const double left = i % 2 == 0 ? 0 : 1;
      chains.push_back({{{left, i}, {left + 1, i}}, 1});
      chains.push_back({{{left, i + 1}, {left + 1, i + 1}}, -1});
    }
    const Contours contours = stitched(chains, {0, 1, 2});
    ASSERT_EQ(contours.loop_count(), static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < contours.loop_count(); ++i) {
      EXPECT_EQ(signed_area(contours.loop(i)), 1) << i;
    }
  }
}

TEST(Stitcher, AddsLoneLoopsAsTheyAre) {
  const std::vector<Vec2> lower = {{0, 0}, {1, -1}, {2, 0}};
  const std::vector<Vec2> upper = {{0, 0}, {1, 1}, {2, 0}};
  Stitcher stitcher({.tie_distance = kTie, .merge_distance = kMerge});
  stitcher.begin();
  stitcher.add_loop(lower, upper, 1);
  stitcher.add_loop(lower, upper, -1);
  Contours contours;
  stitcher.write_loops(contours);
  ASSERT_EQ(contours.loop_count(), 2U);
  EXPECT_EQ(signed_area(contours.loop(0)), 2);
  EXPECT_EQ(signed_area(contours.loop(1)), -2);
}

TEST(Stitcher, NotesBoundaryThatJumpsByLessThanATie) {
  const std::vector<Vec2> lower = {{0, 0}, {2, 0}};
  const std::vector<Vec2> upper = {{0, 1}, {2, 1}};
  for (const double jump : {0.0, 0.5 * kTie, 100 * kTie}) {
    Stitcher stitcher({.tie_distance = kTie, .merge_distance = kMerge});
    stitcher.begin();
    const std::uint32_t first = stitcher.start_arc({0, 0}, 0, lower.data(), 1);
    stitcher.start_arc({0, 1}, 1, upper.data(), -1);
    stitcher.link_ends();
    EXPECT_FALSE(stitcher.has_jumps());
    stitcher.end_arc(first, {1, 0}, 0, lower.data());
    stitcher.start_arc({1, jump}, jump, lower.data(), 1);
    stitcher.link_ends();
    EXPECT_EQ(stitcher.has_jumps(), jump == 0.5 * kTie) << jump;
  }
}

}  // namespace
}  // namespace lamina::plane
