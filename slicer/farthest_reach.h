#pragma once
// How far a straight line can go along a chain of vertices.

#include <cstdint>
#include <span>

#include "csg/vec.h"

namespace lamina::slicer {

// The last vertex, at most `end`, for which the line from `anchor` to it passes
// all vertices between within the tolerance [mm] and leaves none of them behind
// or before itself. Nearly always the last: a search ends where the chain has
// led away for long.
//
// By a cone of directions that narrows with every vertex (Imai and Iri 1988),
// O(1) each.
std::uint32_t farthest_reach(std::span<const Vec2> points, std::uint32_t anchor,
                             std::uint32_t end, double tolerance);

}  // namespace lamina::slicer
