#pragma once
// What a leaf shows of its convex parts.

#include <optional>
#include <vector>

#include "csg/minkowski/convex.h"
#include "csg/scene.h"

namespace lamina::csg {

// The leaf as a union of convex solids under the matrix, where its form tells
// how: an extrusion is cut in the plane of its outlines, a body of revolution
// in the plane of its profile, and there into wedges from fragment to fragment
// unless it is convex as a whole. No value for any other leaf, unless it is
// convex.
std::optional<std::vector<Convex>> convex_parts(const Leaf& leaf,
                                                const Affine& matrix);

// The leaf under a singular matrix, as a union of flat convex bodies.
std::vector<Convex> flat_parts(const Leaf& leaf, const Affine& matrix);

}  // namespace lamina::csg
