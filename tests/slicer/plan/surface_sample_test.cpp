#include "slicer/plan/detail/surface_sample.h"

#include <gtest/gtest.h>

#include "tests/support/design.h"

namespace lamina::slicer {
namespace {

using support::Design;

constexpr std::size_t kAll = 100'000'000;

// Each hole is cut through both faces of the plate, and each peg stands on it.
constexpr const char* kPegs =
    "difference() { cube([100, 100, 2]);"
    "for (x = [1 : 30], y = [1 : 30]) translate([3 * x, 3 * y, -1])"
    "cylinder(r = 1, h = 4, $fn = 6); }"
    "for (x = [0 : 30], y = [0 : 30]) translate([3 * x + 1.5, 3 * y + 1.5, 1])"
    "cylinder(r = 0.3, h = 5, $fn = 5);";

TEST(SampleSurface, OfFewFacesIsExact) {
  const Design design = Design::from_text(
      "difference() { cube(4); translate([2, 2, 2]) cube(4); }");
  const SurfaceSample sample = sample_surface(design.scene(), kAll);
  EXPECT_NEAR(sample.area, 96, 1e-6);
  EXPECT_EQ(sample.doubt, 0);
  EXPECT_EQ(sample.box.low, Vec3(0));
  EXPECT_EQ(sample.box.high, Vec3(4));
}

TEST(SampleSurface, OfManyFacesIsNearAndSaysHowNear) {
  const Design design = Design::from_text(kPegs);
  const SurfaceSample exact = sample_surface(design.scene(), kAll);
  const SurfaceSample sample = sample_surface(design.scene(), 1);
  EXPECT_EQ(exact.doubt, 0);
  EXPECT_GT(sample.doubt, 0);
  EXPECT_LT(sample.parts.size(), exact.parts.size());
  EXPECT_NEAR(sample.area, exact.area, sample.doubt);
  EXPECT_LT(sample.doubt, 0.05 * exact.area);
  EXPECT_EQ(sample.box.low, exact.box.low);
  EXPECT_EQ(sample.box.high, exact.box.high);
}

}  // namespace
}  // namespace lamina::slicer
