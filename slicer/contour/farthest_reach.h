#pragma once
// How far a straight line can go along a chain of vertices.

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace lamina::slicer {

// Appends the vertices of the chain [begin, end] of `points` that are enough
// for a line within the tolerance [mm]: from each the next is the last one for
// which the line to it passes all vertices between within the tolerance and
// leaves none of them behind or before itself. Nearly always the last: a search
// ends where the chain has led away for long. Both ends are among them.
//
// By a cone of directions that narrows with every vertex (Imai and Iri 1988),
// O(1) each.
void choose_farthest(std::span<const Vec2> points, std::uint32_t begin,
                     std::uint32_t end, double tolerance,
                     std::vector<std::uint32_t>& chosen);

}  // namespace lamina::slicer
