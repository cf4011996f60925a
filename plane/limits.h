#pragma once
// What the plane does not hold: more corners than memory has room for, and
// coordinates too large for exact layers.
//
// They are checked before anything is made of them. The check does not know the
// place in the text; the walk over the tree does, and adds it to the error.

#include <cmath>
#include <cstddef>

#include "base/diagnostic.h"

namespace lamina::plane {

// Corners of a region of the plane, or of all outlines of a FreeCAD file. A
// star of 3,001 points crosses itself 4.5 million times.
constexpr double kMostCorners = 1 << 22;

// Up to here doubles are ten times finer than the distance at which faces tie
// [mm]. Layers of what lies beyond would be wrong, so it is refused.
constexpr double kGreatestCoordinate = 1e9;

// A GeometryError without a place.
struct LimitExceeded : GeometryError {
  using GeometryError::GeometryError;
};

// Throws LimitExceeded where there are more.
void require_corners(std::size_t count);
[[noreturn]] void fail_too_far();

// NaN is too far as well.
inline bool is_too_far(double coordinate) {
  return !(std::abs(coordinate) <= kGreatestCoordinate);
}

}  // namespace lamina::plane
