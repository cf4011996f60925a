// The packer: laws that every plan keeps, and small plates whose plan is known.

#include "slicer/plate/packer.h"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "slicer/plate/distance.h"
#include "tests/slicer/plate/plate_checks.h"

namespace lamina::slicer {
namespace {

// Some large, some like needles, some with a hole, some of quantity 0.
std::vector<Piece> random_pieces(std::mt19937& random) {
  std::vector<Piece> pieces(1 + random() % 6);
  for (Piece& piece : pieces) {
    switch (random() % 4) {
      case 0:
        piece.footprint =
            rectangle(0.01 + 40 * share(random), 0.01 + 2 * share(random));
        break;
      case 1:
        piece.footprint =
            annulus(5 + 10 * share(random), 4 * share(random) + 0.5, 40);
        break;
      default:
        piece.footprint = random_star(random, 1 + 20 * share(random));
    }
    piece.height = 30 * share(random);
    piece.quantity = random() % 5;
  }
  return pieces;
}

TEST(PackPlates, RandomPiecesKeepAllPromises) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    const std::vector<Piece> pieces = random_pieces(random);
    Plate plate;
    plate.size = Vec2(20 + number(random, 60), 20 + number(random, 40));
    plate.gap = 0.1 * std::max(number(random, 40) - 10, 0);
    plate.margin = 0.5 * number(random, 5);
    plate.turns = 1 + static_cast<unsigned>(number(random, 9));
    plate.most_plates = random() % 4;
    plate.work = 20;
    const PlatePlan plan = pack_plates(pieces, plate);
    ASSERT_EQ(faults_of(pieces, plate, plan), "") << "seed " << seed;
  }
}

TEST(PackPlates, SquaresThatTouchFillAPlate) {
  const std::vector<Piece> pieces = {{rectangle(10, 10), 1, 8}};
  const Plate plate{.size = {40, 20}, .turns = 4};
  const PlatePlan plan = pack_plates(pieces, plate);
  EXPECT_EQ(plan.plates, 1U);
  EXPECT_EQ(faults_of(pieces, plate, plan), "");
}

TEST(PackPlates, APieceOfThePlatesSizeFitsInsideTheMargin) {
  const std::vector<Piece> pieces = {{rectangle(36, 16), 1, 2}};
  const Plate plate{.size = {40, 20}, .gap = 2, .margin = 2};
  const PlatePlan plan = pack_plates(pieces, plate);
  EXPECT_EQ(plan.plates, 2U);
  EXPECT_EQ(faults_of(pieces, plate, plan), "");
}

TEST(PackPlates, ALongPieceIsTurnedUntilItFits) {
  const std::vector<Piece> pieces = {{rectangle(50, 1), 1, 1}};
  EXPECT_EQ(pack_plates(pieces, {.size = {40, 40}, .turns = 8}).plates, 1U);
  EXPECT_EQ(pack_plates(pieces, {.size = {40, 40}, .turns = 4}).too_large,
            std::vector<std::size_t>{0});
}

TEST(PackPlates, PiecesThatFitNoPlateAreReportedAndOthersLaid) {
  const std::vector<Piece> pieces = {{rectangle(10, 10), 1, 1},
                                     {rectangle(90, 90), 1, 3},
                                     {rectangle(5, 5), 1, 1}};
  const PlatePlan plan = pack_plates(pieces, {.size = {40, 20}});
  EXPECT_EQ(plan.too_large, std::vector<std::size_t>{1});
  EXPECT_EQ(plan.placements.size(), 2U);
}

TEST(PackPlates, WhatFindsNoRoomGoesToFurtherPlatesOrIsCounted) {
  const std::vector<Piece> pieces = {{rectangle(18, 18), 1, 5}};
  Plate plate{.size = {40, 20}, .gap = 1};
  EXPECT_EQ(pack_plates(pieces, plate).plates, 3U);
  plate.most_plates = 2;
  const PlatePlan plan = pack_plates(pieces, plate);
  EXPECT_EQ(plan.plates, 2U);
  EXPECT_EQ(plan.left_over, std::vector<std::size_t>{1});
}

TEST(PackPlates, ASmallRingLiesInALargeOne) {
  const std::vector<Piece> pieces = {{annulus(19, 16, 100), 5, 1},
                                     {annulus(13, 11, 100), 5, 1},
                                     {annulus(8, 6, 100), 5, 1}};
  const Plate plate{.size = {40, 40}, .gap = 1.5};
  const PlatePlan plan = pack_plates(pieces, plate);
  EXPECT_EQ(plan.plates, 1U);
  EXPECT_EQ(faults_of(pieces, plate, plan), "");
}

TEST(PackPlates, PiecesOfLikeHeightShareAPlate) {
  const std::vector<Piece> pieces = {{rectangle(18, 18), 10, 1},
                                     {rectangle(19, 18), 30, 1},
                                     {rectangle(18, 18), 29, 1},
                                     {rectangle(19, 18), 11, 1}};
  const PlatePlan plan = pack_plates(pieces, {.size = {40, 20}, .gap = 1});
  ASSERT_EQ(plan.placements.size(), 4U);
  EXPECT_EQ(plan.placements[0].piece, 1U);
  EXPECT_EQ(plan.placements[1].piece, 2U);
  EXPECT_EQ(plan.placements[1].plate, 0U);
  EXPECT_EQ(plan.placements[2].plate, 1U);
}

TEST(PackPlates, NoPiecesAndNoCopiesNeedNoPlate) {
  EXPECT_EQ(pack_plates({}, {.size = {40, 20}}).plates, 0U);
  const std::vector<Piece> pieces = {{rectangle(1, 1), 1, 0}, {{}, 1, 0}};
  EXPECT_EQ(pack_plates(pieces, {.size = {40, 20}}).plates, 0U);
}

TEST(PackPlates, TheSearchSavesAPlate) {
  int saved = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::vector<Piece> pieces;
    while (pieces.size() < 10 + seed % 8) {
      pieces.push_back({random_star(random, 12), 10, 1});
    }
    Plate plate{.size = {60, 50}, .gap = 1, .work = 0};
    const std::size_t before = pack_plates(pieces, plate).plates;
    plate.work = 100;
    const PlatePlan plan = pack_plates(pieces, plate);
    EXPECT_EQ(faults_of(pieces, plate, plan), "") << "seed " << seed;
    EXPECT_LE(plan.plates, before);
    if (plan.plates < before) ++saved;
  }
  EXPECT_GE(saved, 1);
}

TEST(PackPlates, TheSearchFindsRoomForWhatWasLeftOver) {
  std::mt19937 random(4);
  std::size_t fewer = 0;
  for (int round = 0; round < 10; ++round) {
    const std::vector<Piece> pieces = {{random_star(random, 9), 1, 30}};
    Plate plate{.size = {60, 50}, .gap = 1, .most_plates = 1, .work = 0};
    const std::size_t before = pack_plates(pieces, plate).left_over[0];
    plate.work = 100;
    const PlatePlan plan = pack_plates(pieces, plate);
    EXPECT_EQ(faults_of(pieces, plate, plan), "");
    fewer += before - plan.left_over[0];
  }
  EXPECT_GE(fewer, 5U);
}

TEST(PackPlates, TheNumberOfThreadsChangesNothing) {
  std::mt19937 random(7);
  std::vector<Piece> pieces;
  while (pieces.size() < 20) {
    pieces.push_back({random_star(random, 12), 30 * share(random), 2});
  }
  const Plate plate{.size = {60, 50}, .gap = 1};
  const PlatePlan plan = pack_plates(pieces, plate);
  const tbb::global_control one_thread(
      tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(pack_plates(pieces, plate).placements, plan.placements);
}

TEST(FindTooNear, AgreesWithDistancesEdgeByEdge) {
  std::mt19937 random(3);
  for (int round = 0; round < 200; ++round) {
    std::vector<plane::Region> regions;
    for (int i = 0; i < 6; ++i) {
      const Vec2 shift(number(random, 60), number(random, 60));
      regions.push_back(place(
          random() % 3 == 0 ? annulus(15, 12, 30) : random_star(random, 9),
          7.0 * number(random, 50), shift));
    }
    const double gap = 0.01 + 0.1 * number(random, 40);
    std::vector<NearPair> expected;
    for (std::size_t i = 0; i < regions.size(); ++i) {
      for (std::size_t k = i + 1; k < regions.size(); ++k) {
        if (brute_distance(regions[i], regions[k]) < gap) {
          expected.emplace_back(i, k);
        }
      }
    }
    EXPECT_EQ(find_too_near(regions, gap), expected) << "round " << round;
  }
}

TEST(FindTooNear, RegionsThatTouchAreApartAtGapZero) {
  const plane::Region square = rectangle(10, 10);
  const std::vector<plane::Region> touching = {square,
                                               place(square, 90, {20, 3})};
  EXPECT_TRUE(find_too_near(touching, 0).empty());
  EXPECT_EQ(find_too_near(touching, 0.1).size(), 1U);
  const std::vector<plane::Region> overlapping = {square,
                                                  place(square, 0, {9.99, 3})};
  EXPECT_EQ(find_too_near(overlapping, 0).size(), 1U);
}

TEST(FindTooNear, ARegionInsideAnotherIsTooNearAndOneInItsHoleIsNot) {
  const std::vector<plane::Region> crossing = {
      rectangle(20, 20), place(rectangle(2, 2), 0, {9, 9})};
  EXPECT_EQ(find_too_near(crossing, 1).size(), 1U);
  EXPECT_EQ(find_too_near(crossing, 0).size(), 1U);
  const std::vector<plane::Region> in_hole = {annulus(20, 16, 100),
                                              annulus(12, 10, 100)};
  EXPECT_TRUE(find_too_near(in_hole, 3.9).empty());
  EXPECT_EQ(find_too_near(in_hole, 4.1).size(), 1U);
}

}  // namespace
}  // namespace lamina::slicer
