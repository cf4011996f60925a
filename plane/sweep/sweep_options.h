#pragma once
// What the moving ray is asked for, and what it counts.

#include <cstdint>

#include "plane/chains.h"
#include "plane/tie_distance.h"

namespace lamina::plane {

// What the moving ray takes for one point, one edge, or nothing.
struct SweepOptions {
  // Distance of the look-ahead rays [mm]; 0 = auto. A speed knob only.
  double pitch = 0;
  // Edges nearer than this are one [mm].
  double tie_distance = kTieDistance;
  // Points of a loop nearer than this are one, and one that is nearer than
  // this to the line through its neighbours is left out [mm].
  double merge_distance = kClusterWidth;
  // Loops with less area [mm²] are dropped: 31 nm squared, the leftovers of
  // faces of solids that coincide up to rounding.
  double least_area = 1e-9;
};

// What the moving ray met, added up over layers (`--report`).
struct SweepCounts {
  std::uint64_t layers = 0;
  std::uint64_t chains = 0;
  std::uint64_t points = 0;  // vertices of chains
  std::uint64_t slabs = 0;
  std::uint64_t event_points = 0;
  std::uint64_t states = 0;  // of the Boolean program, as they were met
  // Layers with faces nearer than a tie but not the same: their loops were
  // swept once more.
  std::uint64_t resolved_layers = 0;
  // What must not happen (plane/sweep/ray_sweep.h): always 0.
  std::uint64_t unbalanced_clusters = 0;  // I1: a leaf did not end on the ray
  std::uint64_t repaired_clusters = 0;    // I4: an end found no partner
  std::uint64_t capped_clusters = 0;      // I6: swaps reached their cap

  SweepCounts& operator+=(const SweepCounts& other) {
    layers += other.layers;
    chains += other.chains;
    points += other.points;
    slabs += other.slabs;
    event_points += other.event_points;
    states += other.states;
    resolved_layers += other.resolved_layers;
    unbalanced_clusters += other.unbalanced_clusters;
    repaired_clusters += other.repaired_clusters;
    capped_clusters += other.capped_clusters;
    return *this;
  }
};

}  // namespace lamina::plane
