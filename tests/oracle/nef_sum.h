#pragma once
// Minkowski sums by CGAL: solids cut into convex pieces, all pairs of pieces
// summed and united. Seconds for what takes lamina milliseconds, so only for
// few and small scenes.

#include <span>

#include "csg/scene.h"
#include "tests/oracle/world_scene.h"

namespace lamina::oracle {

// The boundary of the sum of all operands, triangulated and rounded to doubles.
// None of them empty; at least one. Throws what nef_boundary throws.
csg::Mesh nef_sum(std::span<const WorldScene> operands);

}  // namespace lamina::oracle
