#pragma once
// Makes loops regular that run into themselves or each other. The moving ray
// does it, with one leaf that may overlap itself.

#include <memory>

#include "plane/contours.h"
#include "plane/program/boolean_program.h"
#include "plane/sweep/sweep_options.h"

namespace lamina::plane {

class LoopResolver {
 public:
  // rule  which winding numbers are solid
  LoopResolver(const SweepOptions& options, FillRule rule);
  ~LoopResolver();

  // Replaces the loops by those of the solid: simple, outer ones
  // counter-clockwise, holes clockwise.
  void resolve(Contours& contours);

  // As resolve(), but gives up where loops cross so often that parts of the
  // solid had better be swept by themselves (plane/cascade/cascade.h): then it
  // returns false and leaves `contours` as they were.
  bool resolve_few_crossings(Contours& contours);

  // Counts all sweeps since construction.
  SweepCounts counts() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lamina::plane
