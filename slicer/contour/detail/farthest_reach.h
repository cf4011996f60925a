#pragma once
// How far a straight line can go along a chain of vertices.

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace lamina::slicer {

// Appends the vertices of the chain [begin, end] of `points` that a line within
// the tolerance [mm] needs, both ends among them. From each, the next is the
// last one for which the line to it passes all vertices between within the
// tolerance and leaves none behind or before itself. (Nearly always the last: a
// search ends where the chain has led away for long.)
//
// A cone of directions narrows with every vertex (Imai and Iri 1988), in O(1).
void choose_farthest(std::span<const Vec2> points, std::uint32_t begin,
                     std::uint32_t end, double tolerance,
                     std::vector<std::uint32_t>& chosen);

}  // namespace lamina::slicer
