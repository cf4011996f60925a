#pragma once
// A second opinion on exact sections: CGAL's 2D Boolean sets.
//
// They unite, intersect and subtract the exact leaf sections of
// `exact_section` as polygons along the tree of operators, where that one
// classifies the cells of one arrangement. They are slower; so they judge the
// judge.

#include <string>

#include "tests/oracle/exact_region.h"
#include "tests/oracle/world_scene.h"

namespace lamina::oracle {

struct SetSection {
  std::string area;  // exact, as `exact_area` writes it
  // As the sets count them: polygons, and holes of polygons. Where boundaries
  // touch in a point this may differ from RegionCounts.
  RegionCounts counts;
};

SetSection section_by_sets(const WorldScene& scene, double z);

}  // namespace lamina::oracle
