#pragma once
// Both coordinates of a point in one register, for loops over long runs of
// points: half the sums and products, a quarter of the least and greatest.
//
// This is the notation of GCC and Clang, which works on processors with such
// registers and without.

#include <cstring>

#include "base/vec.h"

namespace lamina {

using Lanes = double __attribute__((vector_size(2 * sizeof(double))));

inline Lanes lanes_of(const Vec2& point) {
  Lanes lanes;
  std::memcpy(&lanes, &point, sizeof(lanes));
  return lanes;
}
inline Vec2 point_of(Lanes lanes) {
  Vec2 point;
  std::memcpy(&point, &lanes, sizeof(lanes));
  return point;
}
inline Lanes both_lanes(double value) { return Lanes{value, value}; }

// The least and the greatest of each coordinate by itself.
inline Lanes least(Lanes a, Lanes b) { return a < b ? a : b; }
inline Lanes greatest(Lanes a, Lanes b) { return a > b ? a : b; }

// Whether a comparison holds for one of the coordinates.
template <typename Comparison>
bool holds_for_any(const Comparison& comparison) {
  return (comparison[0] | comparison[1]) != 0;
}

}  // namespace lamina
