#include "ldni/sweep/sweep_counts.h"

namespace lamina::ldni {

SweepCounts& SweepCounts::operator+=(const SweepCounts& other) {
  layers += other.layers;
  chains += other.chains;
  points += other.points;
  slabs += other.slabs;
  stops += other.stops;
  evaluations += other.evaluations;
  resolved_layers += other.resolved_layers;
  unbalanced_columns += other.unbalanced_columns;
  repaired_columns += other.repaired_columns;
  capped_columns += other.capped_columns;
  return *this;
}

}  // namespace lamina::ldni
