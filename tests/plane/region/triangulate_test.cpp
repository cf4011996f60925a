#include "plane/region/triangulate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "csg/facets.h"
#include "plane/loop_area.h"
#include "plane/predicates.h"
#include "plane/region/boolean.h"
#include "tests/plane/region/lattice_walks.h"

namespace lamina::plane {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

std::vector<Vec2> all_points(const Region& region) {
  std::vector<Vec2> points;
  for (const Contour& contour : region.contours) {
    points.insert(points.end(), contour.begin(), contour.end());
  }
  return points;
}

// The region's edges minus those of the triangles; nothing where each edge is
// covered as the contract says.
bool covers_edges(const Region& region,
                  const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::map<Edge, int> balance;
  std::uint32_t first = 0;
  for (const Contour& contour : region.contours) {
    const auto n = static_cast<std::uint32_t>(contour.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      --balance[{first + i, first + (i + 1) % n}];
    }
    first += n;
  }
  for (const auto& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++balance[{t[k], t[(k + 1) % 3]}];
  }
  for (const auto& [edge, count] : balance) {
    const auto twin = balance.find({edge.second, edge.first});
    if (count != (twin == balance.end() ? 0 : twin->second)) return false;
  }
  return true;
}

// Teeth that stand on a bar.
Contour comb(int teeth) {
  Contour contour{{0, -1}, {teeth, -1}};
  for (int i = teeth; i > 0; --i) {
    contour.emplace_back(i, 0);
    contour.emplace_back(i - 0.5, 5);
  }
  contour.emplace_back(0, 0);
  return contour;
}

// All triangles run counter-clockwise and their areas add up.
void expect_sound(const Region& region) {
  const auto triangles = triangulate(region);
  EXPECT_TRUE(covers_edges(region, triangles));
  const auto points = all_points(region);
  double sum = 0;
  for (const auto& t : triangles) {
    const Contour corners{points[t[0]], points[t[1]], points[t[2]]};
    const double part = signed_area(corners);
    EXPECT_GE(part, 0);
    sum += part;
  }
  EXPECT_NEAR(sum, area(region), 1e-9 * (1 + std::abs(area(region))));
}

TEST(Triangulate, ConvexPolygons) {
  for (const int n : {3, 4, 5, 30, 1000}) expect_sound(csg::circle(2, n));
}

TEST(Triangulate, AComb) { expect_sound({{comb(50)}}); }

TEST(Triangulate, HolesAndIslands) {
  const Contour contours[] = {
      {{0, 0}, {20, 0}, {20, 20}, {0, 20}}, {{1, 1}, {9, 1}, {9, 9}, {1, 9}},
      {{3, 3}, {6, 3}, {6, 6}, {3, 6}},     {{11, 2}, {18, 3}, {12, 8}},
      {{2, 12}, {8, 12}, {5, 18}},          {{12, 12}, {18, 12}, {12, 18}}};
  expect_sound(from_contours(contours));
}

TEST(Triangulate, HolesThatTouchInPoints) {
  const Contour contours[] = {{{0, 0}, {8, 0}, {8, 8}, {0, 8}},
                              {{0, 4}, {2, 3}, {4, 4}, {2, 5}},
                              {{4, 4}, {6, 3}, {7, 4}, {6, 5}}};
  expect_sound(from_contours(contours));
}

TEST(Triangulate, SievesOfManyHoles) {
  std::vector<Contour> contours{{{0, 0}, {40, 0}, {40, 40}, {0, 40}}};
  for (int i = 0; i < 100; ++i) {
    Contour hole = csg::circle(1.5, 12).contours[0];
    for (Vec2& p : hole) p += Vec2(2 + 4 * (i % 10), 2 + 4 * (i / 10));
    contours.push_back(hole);
  }
  const Region sieve = from_contours(contours);
  EXPECT_EQ(sieve.contours.size(), 101u);
  expect_sound(sieve);
}

TEST(Triangulate, RandomRegions) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(0, 10);
  for (int round = 0; round < 200; ++round) {
    std::vector<Contour> contours(3);
    for (Contour& contour : contours) {
      for (int i = 0; i < 12; ++i) {
        contour.push_back({coordinate(random), coordinate(random)});
      }
    }
    expect_sound(from_contours(contours));
  }
}

TEST(Triangulate, RegionsThatTouchInManyPoints) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    expect_sound(from_contours(lattice_walks(seed)));
  }
}

// A tip of the outline touches the middle of a hole's side, whichever of its
// sides comes first.
TEST(Triangulate, TipsThatTouchTheMiddleOfAnEdge) {
  const Contour outline{{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 6}, {3, 5}, {0, 4}};
  Contour hole{{3, 3}, {3, 7}, {7, 7}, {7, 3}};
  for (int i = 0; i < 4; ++i) {
    expect_sound({{outline, hole}});
    std::rotate(hole.begin(), hole.begin() + 1, hole.end());
  }
}

TEST(Triangulate, NothingComesOpenWhereThePolygonCutsItself) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> coordinate(0, 10);
  for (int round = 0; round < 200; ++round) {
    Contour contour;
    for (int i = 0; i < 15; ++i) {
      contour.push_back({coordinate(random), coordinate(random)});
    }
    const Region region{{contour}};
    EXPECT_TRUE(covers_edges(region, triangulate(region)));
  }
}

// A search for ears all around, for each of the corners, would take half an
// hour.
TEST(Triangulate, APolygonThatCutsItselfOften) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(0, 100);
  Contour contour;
  for (int i = 0; i < 50'000; ++i) {
    contour.push_back({coordinate(random), coordinate(random)});
  }
  const Region region{{contour}};
  const auto triangles = triangulate(region);
  EXPECT_EQ(triangles.size(), contour.size() - 2);
  EXPECT_TRUE(covers_edges(region, triangles));
}

// The same for each of the corners that stand in line.
TEST(Triangulate, APolygonThatCutsItselfAndHasCornersInLine) {
  constexpr int kCount = 200'000;
  Contour contour;
  for (int i = 0; i <= kCount; ++i) {
    contour.push_back({-1, -1 + 2.0 * i / kCount});
  }
  contour.push_back({10, -10});
  contour.push_back({10, 10});
  const Region region{{contour}};
  const auto triangles = triangulate(region);
  EXPECT_EQ(triangles.size(), contour.size() - 2);
  EXPECT_TRUE(covers_edges(region, triangles));
}

// What is left once the teeth are cut is a row of corners in line,
// of which only the first and the last are ears: to look for these by walks
// around the whole row, or among all corners that once were reflex, would take
// twenty minutes.
TEST(Triangulate, ACombOfManyTeeth) { expect_sound({{comb(200'000)}}); }

TEST(MakeDelaunay, TakesTheShortDiagonalOfAKite) {
  const std::vector<Vec2> kite{{0, 0}, {2, -1}, {9, 0}, {2, 1}};
  std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 2}, {0, 2, 3}};
  make_delaunay(kite, triangles);
  for (const auto& t : triangles) {
    EXPECT_TRUE((t[0] == 1 || t[1] == 1 || t[2] == 1) &&
                (t[0] == 3 || t[1] == 3 || t[2] == 3));
  }
}

// Passes over all edges would take ten minutes.
TEST(MakeDelaunay, TurnsTheDiagonalsOfACombOfManyTeeth) {
  const Contour points = comb(50'000);
  auto triangles = triangulate({{points}});
  make_delaunay(points, triangles);
  EXPECT_TRUE(covers_edges({{points}}, triangles));
  std::map<Edge, std::uint32_t> opposite;
  for (const auto& [a, b, c] : triangles) {
    opposite[{a, b}] = c;
    opposite[{b, c}] = a;
    opposite[{c, a}] = b;
  }
  const auto angle = [&](std::uint32_t at, const Edge& edge) {
    const Vec2 u = points[edge.first] - points[at];
    const Vec2 v = points[edge.second] - points[at];
    return std::atan2(std::abs(cross(u, v)), dot(u, v));
  };
  std::size_t bad = 0;
  for (const auto& [edge, p] : opposite) {
    const auto twin = opposite.find({edge.second, edge.first});
    if (twin == opposite.end()) continue;
    const auto [a, b] = edge;
    const std::uint32_t q = twin->second;
    const bool can_turn = orientation(points[p], points[a], points[q]) > 0 &&
                          orientation(points[q], points[b], points[p]) > 0;
    if (can_turn && angle(p, edge) + angle(q, edge) > std::numbers::pi + 0.011)
      ++bad;
  }
  EXPECT_EQ(bad, 0u);
}

}  // namespace
}  // namespace lamina::plane
