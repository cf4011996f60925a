#pragma once
// Dividing the edges of an outline before it is twisted or unevenly scaled.
//
// Each edge sweeps a side that no plane holds. OpenSCAD 2021.01 leaves edges as
// they are; 2026 divides them, by `segments` or as $fn, $fa and $fs ask.

#include "csg/tree.h"
#include "plane/region/region.h"

namespace lamina::csg {

// slices  of the extrusion: where it is scaled unevenly, the greatest length of
//         an edge in any of them counts
//
// Throws LimitExceeded. Time: n log n in the points that come out.
plane::Region split_contours(const plane::Region& region,
                             const LinearExtrudeParams& params, int slices,
                             Language language);

}  // namespace lamina::csg
