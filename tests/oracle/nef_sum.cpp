#include "tests/oracle/nef_sum.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/minkowski_sum_3.h>

#include "tests/oracle/nef_polyhedron.h"

namespace lamina::oracle {

csg::Mesh nef_sum(std::span<const WorldScene> operands) {
  Nef sum = nef_of(operands[0]);
  for (const WorldScene& scene : operands.subspan(1)) {
    Nef other = nef_of(scene);
    sum = CGAL::minkowski_sum_3(sum, other);
  }
  return mesh_of(sum.regularization());
}

}  // namespace lamina::oracle
