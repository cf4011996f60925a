#pragma once
// The convex parts that a leaf's form shows.

#include <optional>
#include <vector>

#include "csg/minkowski/convex.h"
#include "csg/scene.h"

namespace lamina::csg {

// The leaf under the matrix as a union of convex solids, where its form shows
// them: an extrusion is cut in the plane of its outlines, a body of revolution
// in that of its profile, and where a piece is not convex all around, into
// wedges from fragment to fragment. Any other leaf has a value only if it is
// convex.
std::optional<std::vector<Convex>> convex_parts(const Leaf& leaf,
                                                const Affine& matrix);

// The leaf under a singular matrix, as a union of flat convex bodies.
std::vector<Convex> flat_parts(const Leaf& leaf, const Affine& matrix);

}  // namespace lamina::csg
