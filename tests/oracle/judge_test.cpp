#include "tests/oracle/judge.h"

#include <gtest/gtest.h>

#include "tests/support/contour_checks.h"

namespace lamina::oracle {
namespace {

using Loop = std::vector<Vec2>;

plane::Contours contours_of(const std::vector<Loop>& loops) {
  plane::Contours contours;
  for (const Loop& loop : loops) support::add_loop(contours, loop);
  return contours;
}

Loop square(double x, double y, double side) {
  return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
}

Loop hole(double x, double y, double side) {
  const Loop loop = square(x, y, side);
  return {loop.rbegin(), loop.rend()};
}

std::string complaint(const std::vector<Loop>& expected,
                      const std::vector<Loop>& actual) {
  return judge(region_of_loops(contours_of(expected)), contours_of(actual),
               kExactAllowance)
      .complaint;
}

TEST(Judge, PassesWhatIsRight) {
  const std::vector<Loop> loops = {square(0, 0, 4), hole(1, 1, 1)};
  EXPECT_EQ(complaint(loops, loops), "");
  EXPECT_EQ(complaint({}, {}), "");
}

TEST(Judge, RejectsAMissingHoleHoweverSmall) {
  EXPECT_NE(complaint({square(0, 0, 4), hole(1, 1, 1e-6)}, {square(0, 0, 4)}),
            "");
}

TEST(Judge, RejectsAHoleTooMany) {
  EXPECT_NE(complaint({square(0, 0, 4)}, {square(0, 0, 4), hole(1, 1, 1e-6)}),
            "");
}

TEST(Judge, RejectsALostRegion) {
  EXPECT_NE(complaint({square(0, 0, 4), square(5, 0, 1e-6)}, {square(0, 0, 4)}),
            "");
  EXPECT_NE(complaint({square(0, 0, 4)}, {}), "");
  EXPECT_NE(complaint({}, {square(0, 0, 4)}), "");
}

TEST(Judge, RejectsRegionsMergedAtACorner) {
  const std::vector<Loop> apart = {square(0, 0, 1), square(1, 1, 1)};
  const Loop merged = {{0, 0}, {1, 0}, {1 + 1e-6, 1}, {2, 1},
                       {2, 2}, {1, 2}, {1, 1 + 1e-6}, {0, 1}};
  EXPECT_EQ(complaint(apart, apart), "");
  EXPECT_NE(complaint(apart, {merged}), "");
}

TEST(Judge, RejectsAClosedGap) {
  EXPECT_NE(complaint({square(0, 0, 1), square(1 + 1e-6, 0, 1)},
                      {{{0, 0}, {2 + 1e-6, 0}, {2 + 1e-6, 1}, {0, 1}}}),
            "");
}

TEST(Judge, TakesEitherReadingOfASlitOfRounding) {
  const std::vector<Loop> slit = {square(0, 0, 1), square(1 + 1e-15, 0, 1)};
  const std::vector<Loop> closed = {{{0, 0}, {2, 0}, {2, 1}, {0, 1}}};
  EXPECT_EQ(complaint(slit, closed), "");
  EXPECT_EQ(complaint(closed, slit), "");
}

TEST(Judge, TakesASliverOfRoundingForNothing) {
  const std::vector<Loop> sliver = {{{0, 0}, {1, 0}, {1, 1e-15}}};
  EXPECT_EQ(complaint(sliver, {}), "");
  EXPECT_EQ(complaint({}, sliver), "");
}

TEST(Judge, RejectsAShiftedEdge) {
  const auto moved = [](double shift) -> std::vector<Loop> {
    return {{{0, 0}, {4 + shift, 0}, {4 + shift, 4}, {0, 4}}};
  };
  EXPECT_EQ(complaint(moved(0), moved(1e-7)), "");
  EXPECT_NE(complaint(moved(0), moved(1e-5)), "");
  EXPECT_NE(complaint(moved(0), moved(-1e-5)), "");
}

TEST(Judge, RejectsALoopThatRunsTheWrongWay) {
  EXPECT_NE(complaint({square(0, 0, 4)}, {hole(0, 0, 4)}), "");
  EXPECT_NE(complaint({square(0, 0, 4), hole(1, 1, 1)},
                      {square(0, 0, 4), square(1, 1, 1)}),
            "");
}

TEST(Judge, RejectsALoopGivenTwice) {
  EXPECT_NE(complaint({square(0, 0, 4)}, {square(0, 0, 4), square(0, 0, 4)}),
            "");
}

TEST(Judge, SaysWhere) {
  const std::string text =
      complaint({square(0, 0, 4), hole(1, 1, 1)}, {square(0, 0, 4)});
  EXPECT_NE(text.find("expected 1 regions, 1 holes, got 1 regions, 0 holes"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("largest difference is 1 mm² at ("), std::string::npos)
      << text;
}

}  // namespace
}  // namespace lamina::oracle
