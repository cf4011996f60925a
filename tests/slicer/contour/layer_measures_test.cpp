#include "slicer/contour/layer_measures.h"

#include <vector>

#include <gtest/gtest.h>

#include "tests/support/contour_checks.h"

namespace lamina::slicer {
namespace {

// Around (x, y), a hole if it is turned.
std::vector<Vec2> square(double x, double y, double half, bool is_hole) {
  std::vector<Vec2> loop = {{x - half, y - half},
                            {x + half, y - half},
                            {x + half, y + half},
                            {x - half, y + half}};
  if (is_hole) loop = {loop[3], loop[2], loop[1], loop[0]};
  return loop;
}

TEST(AreasOfRegions, NothingHasNone) {
  EXPECT_TRUE(areas_of_regions({}).empty());
}

TEST(AreasOfRegions, HolesCountForTheRegionRightAroundThem) {
  // A frame, an island with a hole in its hole, and a square beside it; holes
  // come first.
  plane::Contours contours;
  support::add_loop(contours, square(0, 0, 1, true));
  support::add_loop(contours, square(0, 0, 4, true));
  support::add_loop(contours, square(0, 0, 5, false));
  support::add_loop(contours, square(0, 0, 3, false));
  support::add_loop(contours, square(20, 0, 1, false));
  EXPECT_EQ(areas_of_regions(contours),
            (std::vector<double>{100 - 64, 36 - 4, 4}));
}

// The box of the L holds the other square and its hole.
TEST(AreasOfRegions, BoxesDoNotDecide) {
  plane::Contours contours;
  support::add_loop(contours,
                    {{0, 0}, {10, 0}, {10, 1}, {1, 1}, {1, 10}, {0, 10}});
  support::add_loop(contours, square(5, 5, 2, false));
  support::add_loop(contours, square(5, 5, 1, true));
  EXPECT_EQ(areas_of_regions(contours), (std::vector<double>{19, 16 - 4}));
}

}  // namespace
}  // namespace lamina::slicer
