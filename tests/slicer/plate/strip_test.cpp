// Strips: no two pieces overlap, all lie inside, and the search pays.

#include "slicer/plate/strip.h"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/slicer/plate/plate_checks.h"

namespace lamina::slicer {
namespace {

// What a strip breaks of its promises; empty where it keeps them all.
std::string faults_of(std::span<const Piece> pieces, const Strip& strip,
                      const StripPlan& plan) {
  PlatePlan as_plate;
  as_plate.placements = plan.placements;
  as_plate.plates = 1;
  as_plate.left_over.resize(pieces.size());
  return faults_of(
      pieces, {.size = {plan.length, strip.depth}, .gap = strip.gap}, as_plate);
}

std::vector<Piece> stars(unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Piece> pieces(6);
  for (Piece& piece : pieces) {
    piece.footprint = random_star(random, 8);
    piece.quantity = 2;
  }
  return pieces;
}

TEST(PackStrip, KeepsAllPromises) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    const std::vector<Piece> pieces = stars(seed);
    const Strip strip{.depth = 25,
                      .gap = seed % 3 == 0 ? 0 : 0.3 * seed,
                      .turns = 1 + seed % 4,
                      .work = 30};
    EXPECT_EQ(faults_of(pieces, strip, pack_strip(pieces, strip)), "")
        << "seed " << seed;
  }
}

TEST(PackStrip, TheSearchShortensWhatBottomLeftFillMade) {
  const std::vector<Piece> pieces = stars(1);
  Strip strip{.depth = 25, .turns = 4, .work = 0};
  const double before = pack_strip(pieces, strip).length;
  strip.work = 100;
  EXPECT_LT(pack_strip(pieces, strip).length, 0.97 * before);
}

TEST(PackStrip, SquaresLeaveNoRest) {
  const std::vector<Piece> pieces = {{rectangle(10, 10), 0, 8}};
  const StripPlan plan = pack_strip(pieces, {.depth = 20, .work = 10});
  EXPECT_DOUBLE_EQ(plan.length, 40);
}

// One piece alone cannot become shorter than it is in its best turn.
TEST(PackStrip, ALonePieceIsTurned) {
  const std::vector<Piece> pieces = {{rectangle(10, 4), 0, 1}};
  EXPECT_EQ(pack_strip(pieces, {.depth = 12, .turns = 4, .work = 10}).length,
            4);
  EXPECT_EQ(pack_strip(pieces, {.depth = 8, .turns = 4, .work = 10}).length,
            10);
}

TEST(PackStrip, TheSameWorkGivesTheSameStrip) {
  const std::vector<Piece> pieces = stars(2);
  const Strip strip{.depth = 25, .turns = 2, .work = 30};
  const StripPlan plan = pack_strip(pieces, strip);
  EXPECT_EQ(pack_strip(pieces, strip).placements, plan.placements);
}

TEST(PackStrip, NoPiecesNeedNoStrip) {
  EXPECT_EQ(pack_strip({}, {.depth = 10}).length, 0);
}

}  // namespace
}  // namespace lamina::slicer
