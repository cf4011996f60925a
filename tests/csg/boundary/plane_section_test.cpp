// Windows look at few triangles of large faces.

#include "csg/boundary/plane_section.h"

#include <cstddef>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace lamina::csg {
namespace {

// A comb of so many teeth of 1 mm, 1 mm high: its caps are one face each.
Leaf comb(int teeth) {
  std::vector<Vec2> outline;
  for (int i = 0; i < teeth; ++i) {
    outline.emplace_back(-2 * i, 1);
    outline.emplace_back(-2 * i, 2);
    outline.emplace_back(-2 * i - 1, 2);
    outline.emplace_back(-2 * i - 1, 1);
  }
  outline.emplace_back(-2 * teeth, 0);
  outline.emplace_back(0, 0);
  Loft loft;
  loft.outline = std::make_shared<const std::vector<Vec2>>(std::move(outline));
  loft.profile = {{1, 0}, {1, 1}};
  Leaf leaf;
  leaf.lofts.push_back(std::move(loft));
  return leaf;
}

TEST(PlacedLeaf, ShowsFewTrianglesOfALargeFace) {
  constexpr int kTeeth = 500;
  const PlacedLeaf leaf(comb(kTeeth), Affine(1.0));
  std::size_t looks = 0;
  for (int i = 0; i < kTeeth; ++i) {
    // Around the tooth.
    const Box3 box{Vec3(-2 * i - 1.1, 1.5, -1), Vec3(-2 * i + 0.1, 3, 2)};
    std::size_t met = 0;
    leaf.visit_triangles([&](const Box3& other) { return do_meet(box, other); },
                         [&](const LeafFaces::Triangle&) { ++met; });
    EXPECT_GE(met, 10u);  // two of each side, and of each cap
    looks += met;
  }
  EXPECT_LT(looks, 40 * kTeeth);
}

TEST(PlacedLeaf, KnowsWhatLiesInsideOfALargeFace) {
  constexpr int kTeeth = 50;
  const PlacedLeaf leaf(comb(kTeeth), Affine(1.0));
  for (int i = 0; i < kTeeth; ++i) {
    EXPECT_TRUE(
        WindowSection(leaf, Plane(Vec3(0, 0, 0.5), Vec3(0, 0, 1)),
                      {Vec2(-2 * i - 0.6, 1.4), Vec2(-2 * i - 0.4, 1.6)})
            .uniform_value(WindowSection::Side::kAbove)
            .value());
    EXPECT_FALSE(
        WindowSection(leaf, Plane(Vec3(0, 0, 0.5), Vec3(0, 0, 1)),
                      {Vec2(-2 * i + 0.4, 1.4), Vec2(-2 * i + 0.6, 1.6)})
            .uniform_value(WindowSection::Side::kAbove)
            .value());
    // Through the caps, across the teeth.
    EXPECT_TRUE(
        WindowSection(leaf, Plane(Vec3(0, 1.5, 0), Vec3(0, -1, 0)),
                      {Vec2(-2 * i - 0.6, 0.4), Vec2(-2 * i - 0.4, 0.6)})
            .uniform_value(WindowSection::Side::kBelow)
            .value());
  }
}

}  // namespace
}  // namespace lamina::csg
