#pragma once
// The event points of one sweep, one after another: a look into the moving ray.
//
// The sweep itself keeps no such list. The trace steps through it and compares
// the status before and after each event point, so a normal sweep pays nothing
// for it. Cost: an event point takes as long as the ray is long.

#include <cstdint>
#include <vector>

#include "plane/chains.h"
#include "plane/program/boolean_program.h"
#include "plane/sweep/sweep_options.h"

namespace lamina::plane {

// An entry of the status: a chain on the ray.
struct TracedEntry {
  std::uint32_t chain = 0;
  bool is_tied = false;   // with the entry above
  std::int8_t side = 0;   // of boundary: +1 solid above, -1 below, 0 none
  std::uint32_t arc = 0;  // of the boundary, where side is not 0

  bool operator==(const TracedEntry&) const = default;
};

// Pairs of neighbours; the first one is the lower one.
struct TracedPair {
  std::uint32_t lower = 0;
  std::uint32_t upper = 0;

  bool operator==(const TracedPair&) const = default;
};

// What an event point changed; points that change nothing on the ray are left
// out. Chains are numbered as in the layer.
struct TracedEvent {
  double left = 0;  // of the event cluster
  double right = 0;
  std::vector<std::uint32_t> begun;  // from below to above
  std::vector<std::uint32_t> ended;
  // The chains that stay and change places, in the new order.
  std::vector<std::uint32_t> swapped;
  std::vector<TracedPair> tied;
  std::vector<TracedPair> parted;  // that were tied
  std::vector<TracedEntry> arcs_begun;
  std::vector<TracedEntry> arcs_ended;
  // The part of the ray that changed, from below to above, with one entry
  // beside it; and whether there are more below and above.
  std::vector<TracedEntry> ray;
  bool has_more_below = false;
  bool has_more_above = false;
};

struct SweepTrace {
  std::vector<TracedEvent> events;
  // Chains that were never on the ray: lone loops, which meet no other chain,
  // and chains within one event cluster.
  std::vector<std::uint32_t> passed;
};

// Sweeps a layer at once: without groups, and without clipped leaves (see
// plane/cascade/cascade.h).
SweepTrace trace_sweep(const LayerChains& layer, const BooleanProgram& program,
                       const SweepOptions& options = {});

}  // namespace lamina::plane
