// projection() both ways, against areas known otherwise and laws.

#include "csg/boundary/projection.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "plane/region/boolean.h"
#include "tests/csg/lower/lower_fixture.h"
#include "tests/support/formulas.h"
#include "tests/support/leaf_scenes.h"

namespace lamina::csg {
namespace {

class Projections : public LowerFixture {
 protected:
  plane::Region project(const TreeBuilder::Children& children, bool cut) {
    const Lowered lowered = run({b.node(Projection{cut}, children)});
    EXPECT_EQ(lowered.scene(), nullptr);
    return lowered.outline() ? *lowered.outline() : plane::Region{};
  }
  plane::Region shadow(const TreeBuilder::Children& children) {
    return project(children, false);
  }
  plane::Region cut(const TreeBuilder::Children& children) {
    return project(children, true);
  }
};

// Area of what only one of them has.
double difference(const plane::Region& a, const plane::Region& b) {
  const std::vector<plane::Region> ab{a, b};
  const std::vector<plane::Region> ba{b, a};
  return plane::area(plane::subtract(ab)) + plane::area(plane::subtract(ba));
}

using support::polygon_area;

TEST_F(Projections, CutALeafWhereItCrossesThePlane) {
  const plane::Region region =
      cut({b.translate({0, 0, -1}, {b.cylinder(2, 3, 1, 40)})});
  EXPECT_EQ(region.contours.size(), 1u);
  EXPECT_NEAR(plane::area(region), 4 * polygon_area(40), kBooleanRounding);
}

TEST_F(Projections, CutABoolean) {
  const Node* pipe = b.node(
      Difference{}, {b.cylinder(9, 3, 3, 40),
                     b.translate({0, 0, -1}, {b.cylinder(11, 2, 2, 40)})});
  const plane::Region region = cut({b.translate({0, 0, -4}, {pipe})});
  EXPECT_EQ(region.contours.size(), 2u);
  EXPECT_NEAR(plane::area(region), 5 * polygon_area(40), kBooleanRounding);
}

// As in OpenSCAD, which cuts the solid with its surface.
TEST_F(Projections, CutWhatOnlyTouchesThePlane) {
  EXPECT_NEAR(plane::area(cut({b.cube({2, 3, 4})})), 6, kBooleanRounding);
  EXPECT_NEAR(plane::area(cut({b.translate({0, 0, -4}, {b.cube({2, 3, 4})})})),
              6, kBooleanRounding);
  // One stands on the plane, one hangs below it.
  EXPECT_NEAR(plane::area(cut({b.cube({1, 1, 1}),
                               b.translate({1, 0, -2}, {b.cube({3, 1, 2})})})),
              4, kBooleanRounding);
  // A cavity that ends in the plane shows: what is taken away takes its surface
  // along.
  const Node* dented = b.node(
      Difference{},
      {b.cube({4, 4, 4}, true), b.translate({-1, -1, 0}, {b.cube({2, 2, 5})})});
  EXPECT_NEAR(plane::area(cut({dented})), 12, kBooleanRounding);
}

// Whether a vertex this near lies on the plane may be decided either way, but
// for all its faces alike.
// Boxes between whole numbers under random operators: a square of the plane is
// inside a box that is taken with its surface where low ≤ 0 ≤ high, and inside
// one that is cut just above the plane where low ≤ 0 < high.
TEST(CutAtZero, OfBoxesThatTouchThePlaneIsThatOfTheirSquares) {
  constexpr std::uint32_t kSize = 6;
  std::mt19937 random(5);
  for (int round = 0; round < 300; ++round) {
    const auto draw_op = [&] {
      return static_cast<plane::BooleanOp>(random() % 3);
    };
    Scene scene = support::scene_of(draw_op());
    std::vector<std::uint32_t> parents = {0};
    std::vector<Box3> boxes;
    for (int i = 0; i < 6; ++i) {
      if (i == 2 || i == 4) {
        parents.push_back(support::add_operator(scene, draw_op(), 0));
      }
      Box3 box;
      for (int axis = 0; axis < 3; ++axis) {
        const auto low = static_cast<double>(random() % (kSize - 1));
        box.low[axis] = low;
        box.high[axis] = low + (random() % 2 == 0 ? 1 : 2);
      }
      box = box.shifted({0, 0, -3});
      boxes.push_back(box);
      scene.leaves.push_back(
          support::mesh_leaf(support::box_mesh(box.low, box.high)));
      support::place_leaf(scene, static_cast<std::uint32_t>(i), Affine(1.0),
                          parents.back());
    }
    support::cover_instances(scene);
    for (const Touch touch : {Touch::kBothSides, Touch::kAbove}) {
      int squares = 0;
      for (std::uint32_t x = 0; x <= kSize; ++x) {
        for (std::uint32_t y = 0; y <= kSize; ++y) {
          std::vector<bool> inside;
          for (const Box3& box : boxes) {
            const bool is_cut =
                box.low.z <= 0 &&
                (touch == Touch::kAbove ? 0 < box.high.z : 0 <= box.high.z);
            inside.push_back(is_cut && box.low.x <= x && x < box.high.x &&
                             box.low.y <= y && y < box.high.y);
          }
          squares += support::evaluate_program(scene, inside) ? 1 : 0;
        }
      }
      EXPECT_NEAR(plane::area(cut_at_zero(scene, touch)), squares,
                  kBooleanRounding)
          << "round " << round;
    }
  }
}

TEST_F(Projections, CutALeafWithVerticesAtTheVeryLimit) {
  const Node* pipe = b.node(
      Difference{}, {b.sphere(5, 32), b.scale({1, 1, 2}, {b.sphere(2, 32)})});
  const double ring = 5 * std::cos(std::numbers::pi * 7.5 / 16);
  for (const double nudge : {1e-6, -1e-6, 1e-6 + 1e-15, 1e-6 - 1e-15}) {
    const plane::Region region =
        cut({b.translate({0, 0, nudge - ring}, {pipe})});
    EXPECT_EQ(region.contours.size(), 2u);
  }
}

// Where two curved faces cut each other, what is left of their facets meets up
// to rounding: no crack may part the shadow.
TEST_F(Projections, HaveNoCracks) {
  const Node* crescent =
      b.node(Difference{},
             {b.sphere(10, 80), b.translate({5, 3, 1}, {b.sphere(10, 80)})});
  EXPECT_EQ(shadow({crescent}).contours.size(), 1u);
}

TEST_F(Projections, BeyondTheClippersRangeAreRefused) {
  const Node* far = b.translate({1e10, 0, 0}, {b.cube({1, 1, 1})});
  EXPECT_THROW(shadow({far}), GeometryError);
  EXPECT_THROW(cut({far}), GeometryError);
}

TEST_F(Projections, CutBesideThePlaneFails) {
  EXPECT_TRUE(cut({b.translate({0, 0, 1}, {b.cube({1, 1, 1})})}).is_empty());
  EXPECT_EQ(messages(), (std::vector<std::string>{"Projection() failed."}));
}

TEST_F(Projections, OfNothingAreNothing) {
  const Node* nothing =
      b.node(Difference{}, {b.cube({1, 1, 1}), b.cube({1, 1, 1})});
  for (const bool is_cut : {false, true}) {
    EXPECT_TRUE(project({}, is_cut).is_empty());
    EXPECT_TRUE(project({b.cube({0, 1, 1})}, is_cut).is_empty());
    EXPECT_TRUE(project({nothing}, is_cut).is_empty());
    Node* background = b.cube({1, 1, 1});
    background->is_background = true;
    EXPECT_TRUE(project({background}, is_cut).is_empty());
  }
  EXPECT_TRUE(messages().empty());
}

TEST_F(Projections, LeaveOutWhatIsFlat) {
  EXPECT_NEAR(plane::area(shadow({b.node(Square{{5, 5}}), b.cube({1, 1, 1})})),
              1, kBooleanRounding);
  EXPECT_TRUE(messages().empty());
  EXPECT_NEAR(plane::area(cut({b.node(Square{{5, 5}}), b.cube({1, 1, 1})})), 1,
              kBooleanRounding);
  EXPECT_EQ(
      messages(),
      (std::vector<std::string>{"Ignoring 2D child object for 3D operation"}));
}

TEST_F(Projections, OfASphereIsItsWidestRing) {
  const plane::Region region = shadow({b.sphere(5, 60)});
  EXPECT_EQ(region.contours.size(), 1u);
  EXPECT_EQ(region.contours[0].size(), 60u);
  const double r = 5 * std::sin(std::numbers::pi * 14.5 / 30);
  EXPECT_NEAR(plane::area(region), r * r * polygon_area(60), kBooleanRounding);
}

// A torus that stands upright hides its own hole, one that lies shows it.
TEST_F(Projections, OfATorusHaveItsHole) {
  const Node* torus =
      b.node(RotateExtrude{360, 2, {40}},
             {b.translate({3, 0, 0}, {b.node(Square{{1, 1}})})});
  const plane::Region lying = shadow({torus});
  EXPECT_EQ(lying.contours.size(), 2u);
  EXPECT_NEAR(plane::area(lying), 7 * polygon_area(40), kBooleanRounding);
}

TEST_F(Projections, OfADifferenceShowWhatIsLeft) {
  const Node* pierced = b.node(
      Difference{}, {b.cube({6, 6, 6}, true),
                     b.translate({0, 0, -9}, {b.cylinder(18, 2, 2, 30)})});
  const plane::Region region = shadow({pierced});
  EXPECT_EQ(region.contours.size(), 2u);
  EXPECT_NEAR(plane::area(region), 36 - 4 * polygon_area(30), kBooleanRounding);
  // Half of a sphere, cut off upright.
  const Node* half = b.node(
      Intersection{},
      {b.sphere(5, 40), b.translate({0, -9, -9}, {b.cube({18, 18, 18})})});
  EXPECT_NEAR(plane::area(shadow({half})),
              plane::area(shadow({b.sphere(5, 40)})) / 2, kBooleanRounding);
}

TEST_F(Projections, ObeyTheLawsOfSets) {
  std::mt19937 random(5);
  const auto number = [&](int n) { return static_cast<int>(random() % n); };
  const auto solid = [&]() -> const Node* {
    const Vec3 size(1 + number(3), 1 + number(3), 1 + number(3));
    const Vec3 shift(number(3), number(3), -number(3));
    if (number(2) == 0) {
      return b.translate(shift, {b.scale(size, {b.sphere(1, 3 + number(9))})});
    }
    return b.translate(shift + Vec3(0.25, 0.5, -0.125), {b.cube(size)});
  };
  for (int round = 0; round < 100; ++round) {
    SCOPED_TRACE(round);
    const Node* a = solid();
    const Node* c = b.node(Difference{}, {solid(), solid()});
    const std::vector<plane::Region> shadows{shadow({a}), shadow({c})};
    EXPECT_NEAR(difference(shadow({a, c}), plane::unite(shadows)), 0,
                kBooleanRounding);
    // A cut goes through the Boolean, a shadow does not.
    const auto at = [&](const Node* node) {
      return cut({b.translate({0, 0, 0.01}, {node})});
    };
    const std::vector<plane::Region> sections{at(a), at(c)};
    EXPECT_NEAR(difference(at(b.node(Intersection{}, {a, c})),
                           plane::intersect(sections)),
                0, kBooleanRounding);
    EXPECT_NEAR(
        difference(at(b.node(Difference{}, {a, c})), plane::subtract(sections)),
        0, kBooleanRounding);
  }
}

}  // namespace
}  // namespace lamina::csg
