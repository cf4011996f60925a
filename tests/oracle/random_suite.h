#pragma once
// Judges random designs against exact sections: a test tries a few designs,
// bench/random_suite many.
//
// A design is judged at several pitches in 20 to 60 layers, of which every
// other design on a grid has some right at its faces. Of each layer:
//   - loops are simple, closed, disjoint, oriented and free of repeats;
//   - regions and holes are as many as in the section with exact
//     constructions, and the symmetric difference is small (judge.h);
//   - beside every edge of the loops and of every leaf's section, on both
//     sides, and at random places, a point is in a loop if and only if the
//     Boolean of the leaves says so.
// Where faces are nearer than the distance of ties but not the same (kNear),
// either reading passes: counts are taken without what is thinner than ten
// ties, and points nearer than that to a face are not asked.

#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/support/random_design.h"

namespace lamina::oracle {

using support::RandomKind;

struct SuiteTally {
  std::uint64_t designs = 0;
  std::uint64_t empty_designs = 0;  // of these, with nothing to slice
  std::uint64_t leaves = 0;
  std::uint64_t sections = 0;  // exact ones
  std::uint64_t layers = 0;    // judged: one for each section and pitch
  std::uint64_t probes = 0;
  std::uint64_t failures = 0;  // designs
};

// How many leaves the suite gives the design of a seed: 2 to 40.
std::size_t suite_leaf_count(std::uint32_t seed);
// How many layers: 20 to 60.
std::size_t suite_layer_count(std::uint32_t seed);

// Judges one design and adds to the tally.
//
// returns  the first complaint with the design's text; empty: passed
std::string try_design(RandomKind kind, std::uint32_t seed,
                       std::size_t layer_count, SuiteTally& tally);

}  // namespace lamina::oracle
