#pragma once
// The convex hull of a scene.

#include "csg/scene.h"

namespace lamina::csg {

// Leaves that the program only unites give their vertices by formula, and of
// equal leaves only those that stand at a corner of all their places; where
// the program subtracts or intersects, the boundary faces of the result give
// them. Empty where the solid has no volume.
Mesh convex_hull(Scene scene);

}  // namespace lamina::csg
