#pragma once
// Makes loops regular that run into themselves or each other. The moving ray
// does it, with one leaf that may overlap itself.

#include <memory>

#include "ldni/section/contours.h"
#include "ldni/sweep/fill_rule.h"
#include "ldni/sweep/sweep_counts.h"

namespace lamina::ldni {

class LoopResolver {
 public:
  // tie_distance    edges nearer than this at both ends are one [mm]
  // merge_distance  points nearer than this are one, and one that is nearer
  //                 than this to the line through its neighbours is left out
  //                 [mm]
  // rule            which winding numbers are solid
  LoopResolver(double tie_distance, double merge_distance, FillRule rule);
  ~LoopResolver();

  // Replaces the loops by those of the solid: simple, outer ones
  // counter-clockwise, holes clockwise.
  void resolve(Contours& contours);

  // Of all sweeps since construction.
  SweepCounts counts() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lamina::ldni
