#pragma once
// Cells of equal height put together into layers of several cells each.
//
// A formats' table tells the thickness of layers run by run, and has an end
// (SLC: 255 rows). So both count: layers and runs. The search is for the least
// of layers + price · runs, by dynamic programming over the borders; where the
// cheapest stack has too many runs, the price of a run rises until it has not.
// Thinner layers are always allowed, so that a single run of the thinnest is
// the last resort.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lamina::slicer {

// From the lowest up.
struct Cells {
  // Of each cell: how many cells a layer that it is part of may have, at least
  // 1.
  std::vector<std::uint16_t> limits;
  // Of each border, one more than cells: whether a layer must end there.
  std::vector<bool> must_part;
};

// Borders of the layers, in cells: 0 first, then each layer's upper one. Of all
// stacks with so few runs the one of the fewest layers, or close to it.
//
// greatest   cells of a layer, at most; at least 1. Time and memory are that
//            many times the cells.
// most_runs  at least 1
std::vector<std::uint32_t> stack_layers(const Cells& cells,
                                        std::uint16_t greatest,
                                        std::size_t most_runs);

}  // namespace lamina::slicer
