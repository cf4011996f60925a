#include "plane/region/minkowski.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "csg/facets.h"
#include "plane/loop_area.h"
#include "plane/predicates.h"
#include "plane/region/boolean.h"
#include "plane/region/convex_faces.h"
#include "plane/region/triangulate.h"

namespace lamina::plane {
namespace {

constexpr double kGrid = 1e-6;  // of the clipper, times a perimeter [mm²]

Region moved(Region region, Vec2 shift) {
  for (Contour& contour : region.contours) {
    for (Vec2& point : contour) point += shift;
  }
  return region;
}

Region frame(double outer, double inner) {
  return subtract(std::vector{csg::square(Vec2(outer), true),
                              csg::square(Vec2(inner), true)});
}

Region gear(int teeth) {
  Contour contour;
  for (int i = 0; i < 2 * teeth; ++i) {
    const double angle = std::numbers::pi * i / teeth;
    const double r = i % 2 == 0 ? 3 : 2;
    contour.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  return {{contour}};
}

double overlap_error(const Region& a, const Region& b) {
  return area(a) + area(b) - 2 * area(intersect(std::vector{a, b}));
}

TEST(CutIntoConvex, PiecesAreConvexAndCoverTheRegion) {
  for (const Region& region : {frame(5, 3), gear(7), csg::circle(2, 50)}) {
    double sum = 0;
    for (const Contour& piece : cut_into_convex(region)) {
      sum += signed_area(piece);
      for (std::size_t i = 0; i < piece.size(); ++i) {
        EXPECT_GE(orientation(piece[i], piece[(i + 1) % piece.size()],
                              piece[(i + 2) % piece.size()]),
                  0);
      }
    }
    EXPECT_NEAR(sum, area(region), 1e-12);
  }
}

TEST(CutIntoConvex, AConvexRegionIsOnePiece) {
  EXPECT_EQ(cut_into_convex(csg::circle(2, 50)).size(), 1U);
}

TEST(AddConvex, SquaresAddTheirSides) {
  const Contour sum = add_convex(csg::square({2, 3}, false).contours[0],
                                 csg::square({5, 7}, false).contours[0]);
  EXPECT_EQ(sum, (Contour{{0, 0}, {7, 0}, {7, 10}, {0, 10}}));
}

TEST(AddConvex, AreaOfSquareAndPolygonIsSteiners) {
  for (const int n : {4, 8, 20, 100}) {
    const Contour disc = csg::circle(0.5, n).contours[0];
    const double width = 2 * 0.5;  // n is a multiple of 4
    EXPECT_NEAR(
        signed_area(add_convex(csg::square({3, 2}, true).contours[0], disc)),
        6 + 3 * width + 2 * width + signed_area(disc), 1e-12);
  }
}

TEST(AddConvex, APointMoves) {
  EXPECT_NEAR(area({{add_convex(csg::circle(1, 7).contours[0], {{5, 6}})}}),
              area(csg::circle(1, 7)), 1e-12);
}

TEST(Add, AHoleShrinksAndCloses) {
  EXPECT_NEAR(area(add(frame(10, 6), csg::square(Vec2(2), true))), 144 - 16,
              kGrid);
  EXPECT_NEAR(area(add(frame(10, 6), csg::square(Vec2(6), true))), 256, kGrid);
}

TEST(Add, ASmallFrameInABigOneLeavesNoCavity) {
  EXPECT_NEAR(area(add(frame(10, 6), frame(1, 0.9))), 121 - 25, kGrid);
  EXPECT_NEAR(area(add(frame(1, 0.9), frame(10, 6))), 121 - 25, kGrid);
}

TEST(Add, ComponentsAddOneByOne) {
  const Region pair =
      unite(std::vector{csg::square(Vec2(1), false),
                        moved(csg::square(Vec2(1), false), Vec2(100, -50))});
  EXPECT_NEAR(area(add(pair, pair)), 3 * 4, kGrid);
}

Region row_of_squares(int count, double side, Vec2 step) {
  Region row;
  for (int i = 0; i < count; ++i) {
    row.contours.push_back(
        moved(csg::square(Vec2(side), false), double(i) * step).contours[0]);
  }
  return row;
}

// So many pairs of pieces are united part by part.
TEST(Add, ARowAndAColumnMakeAGrid) {
  const auto grid = [](double side) {
    return add(row_of_squares(100, side, {3, 0}),
               row_of_squares(100, side, {0, 3}));
  };
  const Region apart = grid(1);
  EXPECT_EQ(apart.contours.size(), 10'000U);
  EXPECT_NEAR(area(apart), 40'000, 1e-6);
  const Region whole = grid(1.5);
  EXPECT_EQ(whole.contours.size(), 1U);
  EXPECT_NEAR(area(whole), 90'000, 1e-6);
}

TEST(Add, CommutesAndFollowsAShift) {
  const Region a = gear(9);
  const Region b = frame(1, 0.5);
  const Region sum = add(a, b);
  EXPECT_NEAR(overlap_error(sum, add(b, a)), 0, kGrid);
  EXPECT_NEAR(overlap_error(moved(sum, {7, -3}), add(a, moved(b, {7, -3}))), 0,
              kGrid);
}

TEST(Add, Associates) {
  const Region a = gear(5);
  const Region b = frame(1, 0.5);
  const Region c = csg::circle(0.3, 9);
  EXPECT_NEAR(overlap_error(add(add(a, b), c), add(a, add(b, c))), 0, kGrid);
}

TEST(Add, NothingAddsToNothing) {
  EXPECT_TRUE(add({}, csg::square(Vec2(1), true)).is_empty());
  EXPECT_TRUE(add(csg::square(Vec2(1), true), {}).is_empty());
}

TEST(Fill, TakesHolesAndWhatIsInThemAway) {
  const Region island = unite(std::vector{frame(10, 6), csg::circle(1, 8)});
  EXPECT_EQ(island.contours.size(), 3U);
  EXPECT_NEAR(area(fill(island)), 100, kGrid);
}

}  // namespace
}  // namespace lamina::plane
