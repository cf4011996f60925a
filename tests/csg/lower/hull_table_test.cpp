// Equal hulls are made once.

#include <cmath>

#include <gtest/gtest.h>

#include "csg/boundary/convex_hull.h"
#include "csg/lower/detail/leaf_store.h"
#include "tests/csg/lower/lower_fixture.h"

namespace lamina::csg {
namespace {

class HullTableTest : public LowerFixture {
 protected:
  Scene capsule(double length) {
    return run_solid(
        {b.sphere(1, 12), b.translate({length, 0, 0}, {b.sphere(1, 12)})});
  }
};

TEST_F(HullTableTest, MakesEqualHullsOnce) {
  HullTable table;
  const Mesh* const first = &table.find_or_make(capsule(3));
  EXPECT_EQ(*first, convex_hull(capsule(3)));
  EXPECT_EQ(&table.find_or_make(capsule(3)), first);
  EXPECT_EQ(table.size(), 1u);
}

TEST_F(HullTableTest, TellsHullsApartByTheLastBit) {
  HullTable table;
  table.find_or_make(capsule(3));
  EXPECT_EQ(table.find_or_make(capsule(std::nextafter(3.0, 4))),
            convex_hull(capsule(std::nextafter(3.0, 4))));
  EXPECT_EQ(table.size(), 2u);
}

TEST_F(HullTableTest, TellsLeavesAndOperatorsApart) {
  HullTable table;
  const Node* const drill = b.translate({0, 0, 5}, {b.cube(Vec3(20))});
  for (const Node* const node :
       {b.node(Difference{}, {b.cube(Vec3(9)), drill}),
        b.node(Intersection{}, {b.cube(Vec3(9)), drill}),
        b.node(Union{}, {b.cube(Vec3(9)), drill}),
        b.node(Union{}, {b.sphere(9, 5), drill})}) {
    const Scene scene = run_solid({node});
    EXPECT_EQ(table.find_or_make(scene), convex_hull(scene));
  }
  EXPECT_EQ(table.size(), 4u);
}

TEST_F(HullTableTest, GivesPlacesOfOneHullOneLeaf) {
  const auto hull = [&] {
    return b.node(Hull{}, {b.sphere(1, 12), b.cube(Vec3(2))});
  };
  const Scene scene = run_solid({hull(), b.translate({5, 0, 0}, {hull()})});
  EXPECT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.leaves.size(), 1u);
}

}  // namespace
}  // namespace lamina::csg
