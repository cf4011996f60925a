#include "csg/plane/offset.h"

#include <numbers>

#include <gtest/gtest.h>

namespace lamina::planar {
namespace {

TEST(Offset, GrowsByAreaPlusBorderPlusCorners) {
  const Region grown = offset(square({4, 3}, false), 0.5, Join::kRound, 1e-4);
  EXPECT_NEAR(area(grown), 12 + 14 * 0.5 + std::numbers::pi * 0.25, 1e-3);
  EXPECT_NEAR(area(offset(square({4, 3}, false), 0.5, Join::kMiter, 0)), 20,
              1e-6);
  EXPECT_NEAR(area(offset(square({4, 3}, false), -0.5, Join::kRound, 1e-4)), 6,
              1e-6);
}

}  // namespace
}  // namespace lamina::planar
