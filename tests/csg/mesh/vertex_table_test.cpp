#include "csg/mesh/vertex_table.h"

#include <gtest/gtest.h>

namespace lamina::csg {
namespace {

TEST(VertexTable, EqualPointsHaveOneName) {
  VertexTable table;
  EXPECT_EQ(table.name({1, 2, 3}), 0U);
  EXPECT_EQ(table.name({3, 2, 1}), 1U);
  EXPECT_EQ(table.name({1, 2, 3}), 0U);
  EXPECT_EQ(table.take_points(), (std::vector<Vec3>{{1, 2, 3}, {3, 2, 1}}));
}

TEST(VertexTable, MinusZeroIsZero) {
  VertexTable table;
  EXPECT_EQ(table.name({0.0, -0.0, 5}), table.name({-0.0, 0.0, 5}));
}

TEST(VertexTable, FindsOnlyWhatItHas) {
  VertexTable table;
  EXPECT_FALSE(table.find({1, 2, 3}));
  table.name({1, 2, 3});
  EXPECT_EQ(table.find({1, 2, 3}), 0U);
  EXPECT_FALSE(table.find({1, 2, 4}));
}

// On a lattice most coordinates are equal, and in both of its orders the names
// are known.
TEST(VertexTable, KeepsItsNamesAsItGrows) {
  constexpr std::uint32_t kSide = 40;
  VertexTable table;
  const auto point = [](std::uint32_t i) {
    return Vec3(i % kSide, i / kSide % kSide, i / (kSide * kSide)) / 8.0;
  };
  constexpr std::uint32_t kCount = kSide * kSide * kSide;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    ASSERT_EQ(table.name(point(i)), i);
  }
  for (std::uint32_t i = kCount; i-- > 0;) ASSERT_EQ(table.name(point(i)), i);
  EXPECT_EQ(table.take_points().size(), kCount);
  EXPECT_EQ(table.name(point(7)), 0U);
}

// Points that repeat soon and late, from a table that guessed too few.
TEST(VertexTable, NamesManyPointsAsOneByOne) {
  std::vector<Vec3> points;
  for (std::uint32_t i = 0; i < 10'000; ++i) {
    points.emplace_back(i * 7919 % 1000, i % 10, -0.5);
  }
  VertexTable one_by_one;
  std::vector<std::uint32_t> expected;
  for (const Vec3& p : points) expected.push_back(one_by_one.name(p));

  for (const std::size_t guess : {0U, 10U, 20'000U}) {
    VertexTable table(guess);
    std::vector<std::uint32_t> names(points.size());
    table.name(points, names);
    EXPECT_EQ(names, expected);
    EXPECT_EQ(table.size(), one_by_one.size());
    EXPECT_EQ(table.find(points.back()), expected.back());
  }
}

}  // namespace
}  // namespace lamina::csg
