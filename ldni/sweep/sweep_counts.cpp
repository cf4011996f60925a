#include "ldni/sweep/sweep_counts.h"

namespace lamina::ldni {

SweepCounts& SweepCounts::operator+=(const SweepCounts& other) {
  layers += other.layers;
  chains += other.chains;
  points += other.points;
  slabs += other.slabs;
  event_points += other.event_points;
  evaluations += other.evaluations;
  resolved_layers += other.resolved_layers;
  unbalanced_clusters += other.unbalanced_clusters;
  repaired_clusters += other.repaired_clusters;
  capped_clusters += other.capped_clusters;
  return *this;
}

}  // namespace lamina::ldni
