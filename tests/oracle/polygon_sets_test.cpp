#include "tests/oracle/polygon_sets.h"

#include <gtest/gtest.h>

#include "tests/oracle/test_meshes.h"

namespace lamina::oracle {
namespace {

TEST(SectionBySets, EqualsTheExactSection) {
  for (const double angle : {0.0, 0.3, 0.7, 2.0}) {
    const WorldScene scene = nested_scene(angle);
    for (const double z : {0.5, 1.5, 2.25, 3.5, 5.0}) {
      const SetSection by_sets = section_by_sets(scene, z);
      const ExactRegion section = exact_section(scene, z);
      EXPECT_EQ(by_sets.area, exact_area(section)) << angle << " " << z;
      EXPECT_EQ(by_sets.counts, count_regions(section)) << angle << " " << z;
    }
  }
}

TEST(SectionBySets, HasTheAreaOfTheFormula) {
  const WorldScene scene = nested_scene(0);
  EXPECT_EQ(section_by_sets(scene, 0.5).area, "36");
  EXPECT_EQ(section_by_sets(scene, 1.5).area, "17");  // 36 - 20 + 1
  EXPECT_EQ(section_by_sets(scene, 9).area, "0");
}

}  // namespace
}  // namespace lamina::oracle
