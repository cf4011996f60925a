#pragma once
// The shell of a solid: all that is near its surface, the wall that hollowing
// leaves.
//
// With F the boundary of the solid and B a ball, the shell is F ⊕ B, and the
// solid hollowed is what of it lies in the shell. The ball is a polyhedron
// around the true one, so that no wall is thinner than asked for; walls at
// right angles to an axis are exactly as thick.

#include "csg/scene.h"

namespace lamina::csg {

// No wall is thicker than its radius by more than this share of it.
inline constexpr double kShellExcess = 0.023;

// All points no farther than `radius` from the boundary of the scene's solid
// [mm], as one leaf, which overlaps itself. Cost: that of the boundary, and
// about n √m + m √n pairs for n faces of it and m of the ball
// (surface_sum.h). Throws LimitExceeded where it has too many facets.
Leaf make_shell(const Scene& solid, double radius);

}  // namespace lamina::csg
