#pragma once
// CGAL makes Minkowski sums: it cuts solids into convex pieces, sums all pairs
// of pieces and unites the sums. It takes seconds where lamina takes
// milliseconds, so tests use it for few and small scenes.

#include <span>

#include "csg/scene.h"
#include "tests/oracle/world_scene.h"

namespace lamina::oracle {

// The boundary of the sum of all operands, triangulated and rounded to doubles.
// None of them empty; at least one. Throws what nef_boundary throws.
csg::Mesh nef_sum(std::span<const WorldScene> operands);

}  // namespace lamina::oracle
