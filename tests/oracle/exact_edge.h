#pragma once
// What an exact region is made of. Only for sources that use CGAL.

#include <vector>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include "tests/oracle/exact_region.h"

namespace lamina::oracle {

using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;

// The region lies on the left.
struct ExactEdge {
  ExactKernel::Point_2 from;
  ExactKernel::Point_2 to;
};

struct ExactRegion::Edges {
  std::vector<ExactEdge> all;
};

}  // namespace lamina::oracle
