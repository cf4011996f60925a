#include "plane/cell_grid.h"

#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include "plane/point_grid.h"
#include "plane/predicates.h"

namespace lamina {
namespace {

class RandomPoints {
 public:
  explicit RandomPoints(unsigned seed) : random_(seed) {}
  Vec2 next(double size) {
    std::uniform_real_distribution<double> any(-size, size);
    const double x = any(random_);
    return {x, any(random_)};
  }
  std::vector<Vec2> list(std::size_t count, double size) {
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < count; ++i) points.push_back(next(size));
    return points;
  }

 private:
  std::mt19937 random_;
};

std::vector<std::uint32_t> all_of(const std::vector<Vec2>& points) {
  std::vector<std::uint32_t> all(points.size());
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

// Whether the segment comes within `reach` of the point in x and y: it meets
// the square around it.
bool meets_square(Vec2 a, Vec2 b, Vec2 point, double reach) {
  double begin = 0;
  double end = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const double from = a[axis] - point[axis];
    const double step = b[axis] - a[axis];
    if (step == 0) {
      if (std::abs(from) > reach) return false;
      continue;
    }
    const double one = (-reach - from) / step;
    const double other = (reach - from) / step;
    begin = std::max(begin, std::min(one, other));
    end = std::min(end, std::max(one, other));
  }
  return begin <= end;
}

TEST(CellGrid, PutsWhatLiesOutsideIntoTheBorder) {
  const CellGrid grid(Vec2(1, 2), Vec2(1, 0.5), 3, 4);
  EXPECT_EQ(grid.size(), 12U);
  EXPECT_EQ(grid.column_of(-1e300), 0U);
  EXPECT_EQ(grid.column_of(1.5), 0U);
  EXPECT_EQ(grid.column_of(2.5), 1U);
  EXPECT_EQ(grid.column_of(1e300), 2U);
  EXPECT_EQ(grid.row_of(3.9), 0U);
  EXPECT_EQ(grid.row_of(4.1), 1U);
  EXPECT_EQ(grid.row_of(1e300), 3U);
  EXPECT_EQ(grid.cell_of({2.5, 4.1}), grid.cell(1, 1));
}

TEST(CellGrid, IsOneCellByDefault) {
  const CellGrid grid;
  EXPECT_EQ(grid.size(), 1U);
  EXPECT_EQ(grid.cell_of({-7, 1e9}), 0U);
}

TEST(CellGrid, HasACellForEachPointOfTheBox) {
  const CellGrid grid(Box2{Vec2(0), Vec2(4, 2)}, 2.0);
  EXPECT_EQ(grid.size(), 9U * 5U);
  EXPECT_NE(grid.cell_of({4, 2}), grid.cell_of({3.9, 1.9}));
  EXPECT_EQ(CellGrid(Box2{Vec2(3), Vec2(3)}, 1.0).size(), 1U);
}

// Within the box of the cells, which the segments leave on all sides.
TEST(CellGrid, VisitsEachCellThatASegmentComesNearOnce) {
  RandomPoints random(1);
  const Vec2 low(-2);
  const Vec2 high(4.5, 1);
  const CellGrid grid(low, Vec2(2, 3), 13, 9);
  for (int i = 0; i < 500; ++i) {
    const Vec2 a = random.next(3);
    const Vec2 b = i % 5 == 0 ? Vec2(a.x, random.next(3).y) : random.next(3);
    const Vec2 reach = glm::abs(random.next(0.3));
    std::set<std::size_t> visited;
    grid.visit_cells(a, b, reach, [&](std::size_t cell) {
      EXPECT_TRUE(visited.insert(cell).second);
      EXPECT_LT(cell, grid.size());
    });
    constexpr int kSteps = 200;
    for (int k = 0; k <= kSteps; ++k) {
      const Vec2 at = a + double(k) / kSteps * (b - a);
      for (const Vec2 corner : {Vec2(0.999), Vec2(-0.999), Vec2(0.999, -0.999),
                                Vec2(-0.999, 0.999)}) {
        const Vec2 place = at + corner * reach;
        if (place != glm::clamp(place, low, high)) continue;
        EXPECT_TRUE(visited.contains(grid.cell_of(place)));
      }
    }
  }
}

TEST(CellLists, KeepTheOrderOfItemsAndJoinNeighbours) {
  CellLists<char> lists;
  lists.fill(4, [](const auto& list) {
    list(2, 'a');
    list(0, 'b');
    list(2, 'c');
    list(3, 'd');
    list(0, 'e');
  });
  const auto text = [](std::span<const char> items) {
    return std::string(items.begin(), items.end());
  };
  EXPECT_EQ(text(lists[0]), "be");
  EXPECT_EQ(text(lists[1]), "");
  EXPECT_EQ(text(lists[2]), "ac");
  EXPECT_EQ(text(lists[3]), "d");
  EXPECT_EQ(text(lists.between(0, 2)), "beac");
  EXPECT_EQ(text(lists.between(1, 3)), "acd");
  lists.fill(1, [](const auto&) {});
  EXPECT_EQ(text(lists[0]), "");
}

TEST(CellLists, AreEmptyAtFirst) { EXPECT_TRUE(CellLists<int>()[0].empty()); }

void expect_all_near(const std::vector<Vec2>& points, RandomPoints& random,
                     double size) {
  PointGrid grid;
  grid.fill(points, all_of(points));
  for (int i = 0; i < 300; ++i) {
    const Vec2 a = random.next(1.2 * size);
    const Vec2 b = i % 7 == 0   ? a
                   : i % 5 == 0 ? Vec2(random.next(1.2 * size).x, a.y)
                                : random.next(1.2 * size);
    const double reach = 0.05 * size * (i % 3);
    std::set<std::uint32_t> found;
    EXPECT_FALSE(grid.has_near(a, b, reach, [&](std::uint32_t member) {
      EXPECT_TRUE(found.insert(member).second);
      return false;
    }));
    for (std::uint32_t k = 0; k < points.size(); ++k) {
      if (!meets_square(a, b, points[k], reach)) continue;
      ASSERT_TRUE(found.contains(k));
      EXPECT_TRUE(
          grid.has_near(a, b, reach, [&](std::uint32_t m) { return m == k; }));
    }
  }
}

TEST(PointGrid, FindsAllPointsNearAnySegment) {
  RandomPoints random(2);
  for (const std::size_t count : {1, 2, 30, 1000}) {
    expect_all_near(random.list(count, 5), random, 5);
  }
}

TEST(PointGrid, FindsPointsInARowAndInOnePlace) {
  RandomPoints random(3);
  std::vector<Vec2> row;
  for (int i = 0; i < 50; ++i) row.emplace_back(0.1 * i, 0);
  expect_all_near(row, random, 5);
  expect_all_near(std::vector<Vec2>(20, Vec2(1, 1)), random, 5);
}

// A plate of small parts, and a part far from it.
std::vector<Vec2> crowded_points() {
  std::vector<Vec2> points;
  for (int x = 0; x < 100; ++x) {
    for (int y = 0; y < 100; ++y) points.emplace_back(0.001 * x, 0.001 * y);
  }
  for (int i = 0; i < 50; ++i) points.emplace_back(0.05 + 1e-9 * i, 0.05);
  points.emplace_back(1000, 1000);
  return points;
}

TEST(PointGrid, FindsPointsInACrowd) {
  RandomPoints random(4);
  expect_all_near(crowded_points(), random, 0.1);
  std::vector<Vec2> twins(100, Vec2(1, 1));
  twins.emplace_back(500, 500);
  expect_all_near(twins, random, 2);
}

TEST(PointGrid, LooksAtFewPointsInACrowd) {
  const std::vector<Vec2> points = crowded_points();
  PointGrid grid;
  grid.fill(points, all_of(points));
  std::size_t looks = 0;
  for (const Vec2& point : points) {
    grid.has_near(point, point + Vec2(0.001, 0), 1e-6, [&](std::uint32_t) {
      ++looks;
      return false;
    });
  }
  EXPECT_LT(looks, 30 * points.size());
}

TEST(PointGrid, HoldsOnlyTheMembersOfTheLastFill) {
  const std::vector<Vec2> points = {{0, 0}, {1, 0}, {2, 0}};
  const auto count = [&](const PointGrid& grid) {
    int sum = 0;
    grid.has_near({-1, 0}, {3, 0}, 0, [&](std::uint32_t) {
      ++sum;
      return false;
    });
    return sum;
  };
  PointGrid grid;
  EXPECT_EQ(count(grid), 0);
  grid.fill(points, all_of(points));
  EXPECT_EQ(count(grid), 3);
  grid.fill(points, std::vector<std::uint32_t>{1});
  EXPECT_EQ(count(grid), 1);
  grid.fill(points, {});
  EXPECT_EQ(count(grid), 0);
}

}  // namespace
}  // namespace lamina
