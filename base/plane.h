#pragma once
// Products of vectors in the plane.

#include "base/vec.h"

namespace lamina {

// Positive where b points to the left of a.
inline double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
inline double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }

}  // namespace lamina
