#pragma once
// Stacks plies of equal height into layers of several plies each.
//
// A format may list the thickness of layers run by run, in a table that has an
// end (SLC: 255 rows). So both count: layers and runs. Dynamic programming over
// the borders finds the least of layers + price · runs; where the cheapest
// stack has too many runs, the price of a run rises until it has not. Thinner
// layers are always allowed, so that a single run of the thinnest is the last
// resort.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lamina::slicer {

// From the lowest up.
struct Plies {
  // For each ply: the most plies of a layer with it, at least 1.
  std::vector<std::uint16_t> limits;
  // For each border, one more than plies: whether a layer must end there.
  std::vector<bool> must_part;
};

// Returns the borders of the layers, in plies: 0 first, then each layer's upper
// one. Of all stacks with so few runs it has the fewest layers, or nearly so.
//
// greatest   the most plies of a layer, at least 1; time and memory grow with
//            it times the plies
// most_runs  at least 1
std::vector<std::uint32_t> stack_layers(const Plies& plies,
                                        std::uint16_t greatest,
                                        std::size_t most_runs);

}  // namespace lamina::slicer
