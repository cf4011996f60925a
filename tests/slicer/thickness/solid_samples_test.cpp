// Points on surfaces and cells inside, against closed formulas.

#include "slicer/thickness/solid_samples.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/support/design.h"

namespace lamina::slicer {
namespace {

using support::Design;

TEST(SampleSolid, HasPointsThatStandForTheSurface) {
  const Design design = Design::from_text(
      "difference() { sphere(6, $fn = 200); translate([1, 0, 0]) sphere(3, "
      "$fn = 200); }");
  const SolidSamples samples = sample_solid(design.scene(), 0.1);
  double area = 0;
  for (const SurfacePoint& point : samples.points) {
    area += point.area;
    // Outside and inside: each point is on its ball, up to its facets.
    const double outer = glm::length(point.place);
    const Vec3 from_hole = point.place - Vec3(1, 0, 0);
    if (std::abs(outer - 6) < 0.01) {
      EXPECT_GT(glm::dot(point.normal, point.place) / outer, 0.999);
    } else {
      EXPECT_NEAR(glm::length(from_hole), 3, 0.01);
      EXPECT_LT(glm::dot(point.normal, from_hole) / 3, -0.99);
    }
    EXPECT_NEAR(glm::length(point.normal), 1, 1e-6);
  }
  EXPECT_NEAR(area, 4 * std::numbers::pi * (36 + 9), 1);
  const double volume = 4.0 / 3 * std::numbers::pi * (216 - 27);
  EXPECT_NEAR(static_cast<double>(samples.cells.size()) * 1e-3, volume,
              volume * 0.001);
}

TEST(SampleSolid, CoversEveryPlaceOfAFacet) {
  // Places of a turned cube's faces, and how far the nearest point is.
  const Design design = Design::from_text(
      "multmatrix([[2, -1, 2], [2, 2, -1], [-1, 2, 2]] / 3) cube(4, center = "
      "true);");
  const double pitch = 0.2;
  const SolidSamples samples = sample_solid(design.scene(), pitch);
  double farthest = 0;
  for (double u = -1.5; u <= 1.5; u += 0.0371) {
    for (double v = -1.5; v <= 1.5; v += 0.0413) {
      const Vec3 place = Vec3(2, 2, -1) / 3.0 * 2.0 + u * Vec3(-1, 2, 2) / 3.0 +
                         v * Vec3(2, -1, 2) / 3.0;
      double nearest = 1e9;
      for (const SurfacePoint& point : samples.points) {
        nearest = std::min(nearest, glm::length(point.place - place));
      }
      farthest = std::max(farthest, nearest);
    }
  }
  EXPECT_LE(farthest, kCover * pitch);
  EXPECT_GT(farthest, 0.1 * pitch);
}

TEST(SolidCells, AreFoundByTheirIndex) {
  const Design design = Design::from_text(
      "difference() { cube(5); translate([1, 1, 1]) cube(3); }");
  const SolidSamples samples = sample_solid(design.scene(), 0.25);
  std::size_t count = 0;
  samples.cells.visit([&](std::uint32_t number, const SolidCells::Index& at) {
    EXPECT_EQ(number, count++);
    EXPECT_EQ(samples.cells.find(at), number);
    const Vec3 middle = samples.cells.middle_of(at);
    const auto same = samples.cells.index_at(middle);
    EXPECT_EQ(samples.cells.find(same), number);
    const Vec3 from_hole = glm::abs(middle - Vec3(2.5));
    EXPECT_GT(std::max({from_hole.x, from_hole.y, from_hole.z}), 1.5 - 1e-9);
  });
  EXPECT_EQ(count, samples.cells.size());
  EXPECT_FALSE(samples.cells.find(samples.cells.index_at(Vec3(2.5))));
  EXPECT_FALSE(samples.cells.find(samples.cells.index_at(Vec3(-3))));
  EXPECT_FALSE(samples.cells.find(samples.cells.index_at(Vec3(9))));
}

TEST(SampleSolid, OfNothingHasNeitherPointsNorCells) {
  const SolidSamples samples =
      sample_solid(Design::from_text("intersection() { cube(1); translate([5, "
                                     "0, 0]) cube(1); }")
                       .scene(),
                   0.1);
  EXPECT_TRUE(samples.points.empty());
  EXPECT_EQ(samples.cells.size(), 0U);
}

}  // namespace
}  // namespace lamina::slicer
