#pragma once
// Points, directions and segments of the plane.
//
// Predicates on which a structure rests are exact: which way three points turn,
// on which side of a ray an edge passes, which of two directions comes first.
// Source: filter and expansion as in Shewchuk, "Adaptive precision
// floating-point arithmetic and fast robust geometric predicates", 1997, cut
// down to two products.

#include <algorithm>
#include <cmath>
#include <span>

#include "base/vec.h"

namespace lamina {

// Positive where b points to the left of a.
inline double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
inline double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }

// Turned by 90° counter-clockwise.
inline Vec2 left_of(Vec2 a) { return {-a.y, a.x}; }

// Whether `a` precedes `b` in ascending x, and in ascending y at equal x.
inline bool precedes(Vec2 a, Vec2 b) {
  return a.x < b.x || (a.x == b.x && a.y < b.y);
}

// +1 where a, b, c run counter-clockwise, -1 clockwise, 0 on one line. Exact
// for coordinates whose products neither overflow nor underflow.
int orientation(Vec2 a, Vec2 b, Vec2 c);

// Compares directions by angle from +x, in [0, 360°): -1, 0 or 1. Exact as
// orientation() is; neither direction is 0.
int compare_angles(Vec2 a, Vec2 b);

// +1 where the edge crosses the ray from `point` along +x upwards, -1
// downwards, else 0. Of its ends the lower one belongs to the edge, so that the
// crossings of a loop add up to its winding number around the point. Exact as
// orientation() is; the reversed edge has the negated crossing. A ray that
// begins on the edge does not cross it.
inline int crossing(Vec2 from, Vec2 to, Vec2 point) {
  const bool goes_up = from.y <= point.y;
  if (goes_up == (to.y <= point.y)) return 0;
  if (goes_up) return orientation(from, to, point) > 0 ? 1 : 0;
  return orientation(to, from, point) > 0 ? -1 : 0;
}

// How often the loop goes around the point, counter-clockwise. Of a simple
// loop: 0 outside, ±1 inside; either where the point lies on it. The first
// point of the loop may be repeated at its end.
int winding_number(std::span<const Vec2> loop, Vec2 point);

// The share of the way from `from` to `to` at which that segment is nearest to
// the point, in [0, 1]; 0 where the ends coincide.
inline double nearest_share(Vec2 point, Vec2 from, Vec2 to) {
  const Vec2 along = to - from;
  const double squared_length = dot(along, along);
  if (!(squared_length > 0)) return 0;
  return std::clamp(dot(point - from, along) / squared_length, 0.0, 1.0);
}

// The distance of a point from a segment.
inline double distance_to_segment(Vec2 point, Vec2 from, Vec2 to) {
  const Vec2 away =
      point - (from + nearest_share(point, from, to) * (to - from));
  return std::sqrt(dot(away, away));
}

}  // namespace lamina
