// Tables of no-fit polygons, against Booleans of the regions themselves.

#include "slicer/plate/detail/no_fit_table.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "plane/region/boolean.h"
#include "plane/region/minkowski.h"
#include "tests/slicer/plate/plate_checks.h"

namespace lamina::slicer {
namespace {

constexpr double kLatticeStep = 0.5;

double common_area(const plane::Region& a, const plane::Region& b, Vec2 shift) {
  return area(
      plane::intersect(std::vector<plane::Region>{a, place(b, 0, shift)}));
}

TEST(NoFitTable, IsZeroExactlyWhereRegionsAreApart) {
  std::mt19937 random(5);
  for (int round = 0; round < 10; ++round) {
    const plane::Region a = random_star(random, 6);
    const plane::Region b =
        round % 2 == 0 ? annulus(5, 3, 12) : random_star(random, 4);
    const NoFitTable table(plane::cut_into_convex(a), plane::cut_into_convex(b),
                           kLatticeStep);
    for (int i = 0; i < 200; ++i) {
      const int column = number(random, 60) - 30;
      const int row = number(random, 60) - 30;
      const double common = common_area(a, b, Vec2(column, row) * kLatticeStep);
      if (common > 1e-4) {
        EXPECT_GT(table.depth(column, row), 0) << common;
      } else if (common < 1e-9) {
        EXPECT_EQ(table.depth(column, row), 0);
      }
    }
  }
}

TEST(NoFitTable, DepthIsTheWayToTheNearestFreePlace) {
  const std::vector<plane::Contour> square =
      plane::cut_into_convex(rectangle(4, 4));
  const NoFitTable table(square, square, kLatticeStep);
  EXPECT_EQ(table.depth(0, 0), 8 * NoFitTable::kStep);
  EXPECT_EQ(table.depth(3, 0), 5 * NoFitTable::kStep);
  EXPECT_EQ(table.depth(-7, 2), NoFitTable::kStep);
  EXPECT_EQ(table.depth(8, 0), 0);
  EXPECT_EQ(table.depth(1000, -1000), 0);
}

TEST(NoFitTable, ASmallRegionFitsTheHoleOfAnother) {
  const NoFitTable table(plane::cut_into_convex(annulus(10, 6, 40)),
                         plane::cut_into_convex(rectangle(3, 3)), 0.5);
  // The hole's middle is at (3, -5).
  EXPECT_EQ(table.depth(3, -13), 0);
  EXPECT_GT(table.depth(3, -1), 0);
}

TEST(NoFitTable, ReversedAnswersForTheOtherRegion) {
  std::mt19937 random(6);
  const auto a = plane::cut_into_convex(random_star(random, 6));
  const auto b = plane::cut_into_convex(random_star(random, 3));
  const NoFitTable table(a, b, kLatticeStep);
  const NoFitTable reversed = table.reversed();
  for (int column = -30; column < 30; ++column) {
    for (int row = -30; row < 30; ++row) {
      EXPECT_EQ(reversed.depth(column, row), table.depth(-column, -row));
    }
  }
}

TEST(NoFitTable, AGridAddsUpDepthsAsFarAsASumCanGrow) {
  std::mt19937 random(7);
  const NoFitTable table(plane::cut_into_convex(random_star(random, 9)),
                         plane::cut_into_convex(random_star(random, 5)),
                         kLatticeStep);
  CoarseGrid grid{{1, 2}, 20, 15, std::vector<std::uint16_t>(20 * 15)};
  table.add_to(grid, {30, 20}, 200);
  table.add_to(grid, {41, 33}, 250);
  for (int i = 0; i < grid.columns; ++i) {
    for (int k = 0; k < grid.rows; ++k) {
      const int column = 1 + NoFitTable::kStride * i;
      const int row = 2 + NoFitTable::kStride * k;
      const int sum = 200 * table.depth(column - 30, row - 20) +
                      250 * table.depth(column - 41, row - 33);
      EXPECT_EQ(grid.sums[static_cast<std::size_t>(i * grid.rows + k)],
                std::min(sum, 65535));
    }
  }
}

TEST(NoFitTable, NothingFitsEverywhere) {
  const NoFitTable table({}, plane::cut_into_convex(rectangle(3, 3)), 0.5);
  EXPECT_EQ(table.depth(0, 0), 0);
}

}  // namespace
}  // namespace lamina::slicer
