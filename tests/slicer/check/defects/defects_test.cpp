// Each defect is found where it was put, and nothing is found in sound layers.

#include "slicer/check/defects/defects.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace lamina::slicer {
namespace {

using WrittenLoops = std::vector<WrittenLoop>;

WrittenLoops closed(const std::vector<std::vector<Vec2>>& loops) {
  plane::Contours contours;
  for (const auto& loop : loops) {
    contours.points.insert(contours.points.end(), loop.begin(), loop.end());
    contours.ends.push_back(static_cast<std::uint32_t>(contours.points.size()));
  }
  return closed_loops(contours);
}

std::vector<Vec2> square(double x, double y, double size) {
  return {{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}};
}

std::vector<Vec2> hole(double x, double y, double size) {
  return {{x, y}, {x, y + size}, {x + size, y + size}, {x + size, y}};
}

// Kinds of all defects, each once.
std::vector<DefectKind> kinds(const WrittenLoops& loops) {
  std::vector<DefectKind> kinds;
  for (const Defect& defect : find_defects(loops)) {
    if (kinds.empty() || kinds.back() != defect.kind) {
      kinds.push_back(defect.kind);
    }
  }
  return kinds;
}

using Kinds = std::vector<DefectKind>;

TEST(FindDefects, SoundLayersHaveNone) {
  EXPECT_EQ(kinds({}), Kinds{});
  EXPECT_EQ(kinds(closed({square(0, 0, 1)})), Kinds{});
  // An island in a hole, beside another part.
  EXPECT_EQ(kinds(closed({square(0, 0, 9), hole(1, 1, 7), square(2, 2, 5),
                          hole(3, 3, 1), square(10, 0, 1)})),
            Kinds{});
}

TEST(FindDefects, PartsMayTouchInAPoint) {
  // Corner to corner; a corner on a side, from outside and from inside.
  EXPECT_EQ(kinds(closed({square(0, 0, 1), square(1, 1, 1)})), Kinds{});
  EXPECT_EQ(kinds(closed({square(0, 0, 2), {{2, 1}, {3, 0.5}, {3, 1.5}}})),
            Kinds{});
  EXPECT_EQ(kinds(closed({square(0, 0, 2), {{2, 1}, {1, 0.5}, {1, 1.5}}})),
            Kinds{});
}

TEST(FindDefects, ALoopWithoutItsClosingVertexIsOpen) {
  WrittenLoops open = closed({square(0, 0, 1)});
  open[0].points.pop_back();
  EXPECT_EQ(kinds(open), Kinds{DefectKind::kOpen});
}

TEST(FindDefects, ALoopWithoutVerticesIsOpen) {
  EXPECT_EQ(kinds(WrittenLoops(1)), Kinds{DefectKind::kOpen});
}

TEST(FindDefects, ALoopThatCountsGapsHasAGap) {
  WrittenLoops gap = closed({square(0, 0, 1)});
  gap[0].gaps = 1;
  EXPECT_EQ(kinds(gap), Kinds{DefectKind::kGap});
}

TEST(FindDefects, EqualNeighboursAreARepeat) {
  EXPECT_EQ(kinds(closed({{{0, 0}, {1, 0}, {1, 0}, {1, 1}}})),
            Kinds{DefectKind::kRepeat});
}

TEST(FindDefects, LoopsMayReachToTheEndOfTheNumbers) {
  constexpr double kFar = 1.5e308;
  const std::vector<Vec2> square = {
      {-kFar, -kFar}, {kFar, -kFar}, {kFar, kFar}, {-kFar, kFar}};
  EXPECT_EQ(kinds(closed({square})), Kinds{});
  // As wide as no number says, and as high as others.
  EXPECT_EQ(kinds(closed({{{-kFar, 0}, {kFar, 0}, {kFar, 1}, {-kFar, 1}}})),
            Kinds{});
}

TEST(FindDefects, ALoopOfTwoVerticesHasNoArea) {
  EXPECT_EQ(kinds(closed({{{0, 0}, {1, 0}}})).front(), DefectKind::kZeroArea);
}

TEST(FindDefects, EdgesCross) {
  const Kinds crossing{DefectKind::kCrossing};
  // A bow tie; two loops.
  EXPECT_EQ(kinds(closed({{{0, 0}, {3, 2}, {3, 0}, {0, 2.5}}})), crossing);
  EXPECT_EQ(kinds(closed({square(0, 0, 2), square(1, 1, 2)})), crossing);
}

TEST(FindDefects, LoopsCrossInAVertex) {
  const Kinds crossing{DefectKind::kCrossing};
  // Of both; of one, on an edge of the other.
  EXPECT_EQ(kinds(closed({{{0, 0}, {1, 1}, {2, 0}, {1, 3}},
                          {{1, 1}, {3, -1}, {4, 1}, {0, 2}}})),
            crossing);
  EXPECT_EQ(
      kinds(closed({square(0, 0, 2), {{1, 1}, {2, 0.5}, {3, 1}, {2, 1.5}}})),
      crossing);
}

TEST(FindDefects, EdgesThatRunAlongEachOtherCross) {
  const Kinds crossing{DefectKind::kCrossing};
  EXPECT_EQ(kinds(closed({square(0, 0, 1), square(1, 0.5, 1)})), crossing);
  EXPECT_EQ(kinds(closed({square(0, 0, 1), square(0, 0, 1)})), crossing);
  // A spike of no width.
  EXPECT_EQ(kinds(closed({{{0, 0}, {2, 0}, {1, 0}, {1, 1}}})), crossing);
}

TEST(FindDefects, EdgesOnOneLineWithoutACommonLengthDoNotCross) {
  EXPECT_EQ(kinds(closed({square(0, 0, 1), square(2, 0, 1)})), Kinds{});
}

TEST(FindDefects, LoopsTurnedAgainstTheirNesting) {
  const Kinds orientation{DefectKind::kOrientation};
  EXPECT_EQ(kinds(closed({hole(0, 0, 1)})), orientation);
  EXPECT_EQ(kinds(closed({square(0, 0, 3), square(1, 1, 1)})), orientation);
  EXPECT_EQ(kinds(closed({square(0, 0, 9), hole(1, 1, 7), hole(2, 2, 5)})),
            orientation);
}

TEST(FindDefects, TellsTheNumberOfTheLoop) {
  const auto defects =
      find_defects(closed({square(0, 0, 9), hole(1, 1, 1), square(3, 3, 1)}));
  ASSERT_EQ(defects.size(), 1U);
  EXPECT_EQ(defects[0].loop, 2U);
}

TEST(FindDefects, SignsAreExactForNeighboursInFloat32) {
  // Slivers one unit of float32 wide, far from the origin: sound or crossing
  // by the last bit.
  const double step = 0x1p-17;  // of float32 at 64 … 128
  EXPECT_EQ(kinds(closed({{{100, 100}, {120, 100}, {120, 100 + step}}})),
            Kinds{});
  const std::vector<Vec2> sliver = {
      {100, 100}, {120, 107}, {110, 103.5 + step}};
  EXPECT_EQ(
      kinds(closed({sliver, {{100, 90}, {120, 107 - step}, {110, 103.5}}})),
      Kinds{});
  EXPECT_EQ(kinds(closed(
                {sliver, {{100, 90}, {120, 107 - step}, {110, 103.5 + step}}})),
            Kinds{DefectKind::kCrossing});
}

TEST(FindDefects, ALargeLayerIsQuick) {
  std::vector<Vec2> rim;
  std::vector<Vec2> inner;
  constexpr int kCount = 200'000;
  for (int i = 0; i < kCount; ++i) {
    const double angle = 6.283185307179586 * i / kCount;
    rim.push_back(10.0 * Vec2(std::cos(angle), std::sin(angle)));
    inner.push_back(9.999 * Vec2(std::cos(-angle), std::sin(-angle)));
  }
  EXPECT_EQ(kinds(closed({rim, inner})), Kinds{});
}

// Edges as long as the layer stood in as many cells as there are edges: a file
// of a megabyte asked for gigabytes, and one of two for more than can be
// counted in 32 bits.
TEST(FindDefects, AHighRowOfLoopsIsQuick) {
  // All in one column of the grid: minutes, if each loop were asked about each.
  constexpr int kLoops = 200'000;
  std::vector<std::vector<Vec2>> loops;
  for (int i = 0; i < kLoops; ++i) {
    loops.push_back({{0, 2.0 * i}, {1, 2.0 * i}, {0, 2.0 * i + 1}});
  }
  loops.push_back(hole(0, 2.0 * kLoops, 1));
  const auto defects = find_defects(closed(loops));
  ASSERT_EQ(defects.size(), 1U);
  EXPECT_EQ(defects[0].kind, DefectKind::kOrientation);
  EXPECT_EQ(defects[0].loop, std::uint32_t{kLoops});
}

TEST(FindDefects, AnUprightLoopWhoseAreaOverflowsHasNoNesting) {
  for (const double far : {1e160, 1e300}) {
    for (const Defect& defect : find_defects(
             closed({{{far, -far}, {far, far}, {far, 0}}, square(0, 0, 1)}))) {
      EXPECT_NE(defect.kind, DefectKind::kOrientation);
    }
  }
}

TEST(FindDefects, LoopsThatTouchHaveANesting) {
  // The corners of a hole are on the sides of the square around it.
  EXPECT_EQ(kinds(closed({{{0, 0}, {4, 0}, {4, 4}, {0, 4}},
                          {{0, 2}, {2, 4}, {4, 2}, {2, 0}}})),
            Kinds{});
  EXPECT_EQ(kinds(closed({{{0, 0}, {4, 0}, {4, 4}, {0, 4}},
                          {{0, 2}, {2, 0}, {4, 2}, {2, 4}}})),
            Kinds{DefectKind::kOrientation});
}

TEST(FindDefects, LongEdgesSideBySideAreQuick) {
  std::vector<std::vector<Vec2>> slats;
  for (int i = 0; i < 10'000; ++i) {
    const double y = 0.001 * i;
    slats.push_back({{0, y}, {1000, y}, {1000, y + 5e-4}, {0, y + 5e-4}});
  }
  EXPECT_EQ(kinds(closed(slats)), Kinds{});
  slats.push_back({{1, -1}, {2, -1}, {2, 11}, {1, 11}});
  EXPECT_EQ(kinds(closed(slats)).front(), DefectKind::kCrossing);
}

}  // namespace
}  // namespace lamina::slicer
