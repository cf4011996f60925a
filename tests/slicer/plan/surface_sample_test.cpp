#include "slicer/plan/detail/surface_sample.h"

#include <cstddef>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "csg/boundary/boundary_faces.h"
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

// By all plane problems.
double area_of(const csg::Scene& scene) {
  double area = 0;
  for (const csg::BoundaryFace& face : csg::boundary_faces(scene)) {
    for (const auto& contour : face.contours) {
      for (std::size_t i = 0; i < contour.size(); ++i) {
        const Vec3 next = contour[(i + 1) % contour.size()];
        area += 0.5 * glm::dot(face.normal, glm::cross(contour[i], next));
      }
    }
  }
  return area;
}

TEST(SampleSurface, OfManyFacesIsNearAndSaysHowNear) {
  const Design design = Design::from_text(kPegs);
  const double area = area_of(design.scene());
  const SurfaceSample all = sample_surface(design.scene(), kAll);
  EXPECT_NEAR(all.area, area, all.doubt);
  const SurfaceSample sample = sample_surface(design.scene(), 1);
  EXPECT_NEAR(sample.area, area, sample.doubt);
  EXPECT_LT(sample.parts.size(), all.parts.size());
  EXPECT_LT(all.doubt, sample.doubt);
  EXPECT_LT(sample.doubt, 0.05 * area);
  for (const SurfaceSample& found : {all, sample}) {
    EXPECT_NEAR(glm::distance(found.box.low, Vec3(0)), 0, 1e-6);
    EXPECT_NEAR(glm::distance(found.box.high, Vec3(100, 100, 6)), 0, 1e-6);
  }
}

}  // namespace
}  // namespace lamina::slicer
