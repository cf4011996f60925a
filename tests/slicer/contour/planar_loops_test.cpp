#include "slicer/contour/detail/planar_loops.h"

#include <array>
#include <cstddef>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "plane/contours.h"
#include "plane/predicates.h"
#include "slicer/check/defects/defects.h"
#include "slicer/contour/layer_file.h"
#include "tests/support/contour_checks.h"

namespace lamina::slicer {
namespace {

constexpr int kSide = 12;

using Cells = std::array<std::array<bool, kSide>, kSide>;

// A loop around each cell, all counter-clockwise.
plane::Contours loops_around(const Cells& cells) {
  plane::Contours contours;
  for (int x = 0; x < kSide; ++x) {
    for (int y = 0; y < kSide; ++y) {
      if (!cells.at(x).at(y)) continue;
      const Vec2 low(x, y);
      contours.add_loop(std::vector<Vec2>{low, low + Vec2(1, 0),
                                          low + Vec2(1, 1), low + Vec2(0, 1)});
    }
  }
  return contours;
}

void expect_region(const plane::Contours& contours, const Cells& cells) {
  for (int x = 0; x < kSide; ++x) {
    for (int y = 0; y < kSide; ++y) {
      int winding = 0;
      for (std::size_t i = 0; i < contours.loop_count(); ++i) {
        winding += winding_number(contours.loop(i), {x + 0.5, y + 0.5});
      }
      EXPECT_EQ(winding, cells.at(x).at(y) ? 1 : 0) << x << ", " << y;
    }
  }
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    std::set<std::pair<double, double>> seen;
    for (const Vec2& point : contours.loop(i)) {
      EXPECT_TRUE(seen.insert({point.x, point.y}).second);
    }
  }
  EXPECT_TRUE(find_defects(closed_loops(contours)).empty());
}

TEST(PlanarLoops, GoAroundTheCellsOfARandomPattern) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    std::mt19937 numbers(seed);
    Cells cells{};
    for (auto& column : cells) {
      for (bool& cell : column) cell = numbers() % 3 != 0;
    }
    plane::Contours contours = loops_around(cells);
    link_planar_loops(contours);
    expect_region(contours, cells);
  }
}

// Black cells of a chessboard touch in corners only.
TEST(PlanarLoops, RegionsThatTouchInAVertexHaveLoopsOfTheirOwn) {
  Cells cells{};
  for (std::size_t x = 0; x < kSide; ++x) {
    for (std::size_t y = 0; y < kSide; ++y) cells[x][y] = (x + y) % 2 == 0;
  }
  plane::Contours contours = loops_around(cells);
  link_planar_loops(contours);
  EXPECT_EQ(contours.loop_count(), kSide * kSide / 2);
  expect_region(contours, cells);
}

TEST(PlanarLoops, VanishWhereEdgesRunToAndFro) {
  plane::Contours contours;
  contours.add_loop(std::vector<Vec2>{{0, 0}, {1, 0}, {2, 0}, {1, 0}});
  link_planar_loops(contours);
  EXPECT_TRUE(contours.is_empty());
  // A spike on a triangle.
  contours.add_loop(std::vector<Vec2>{{0, 0}, {2, 0}, {5, 0}, {2, 0}, {0, 2}});
  link_planar_loops(contours);
  EXPECT_EQ(contours.loop_count(), 1U);
  EXPECT_EQ(contours.points.size(), 3U);
  EXPECT_EQ(support::total_area(contours), 2);
}

}  // namespace
}  // namespace lamina::slicer
