#pragma once
// The Boolean program on one ray.
//
// Over closed leaves a CSG tree becomes set algebra on sorted intervals, one
// ray at a time, so no surface-surface intersection is ever computed.
// Source: Zeng et al. 2011, section 4.2, whose rules (keep the end points of A
// outside of B, …) say which samples of two operands survive; set membership
// classification along a line goes back to Tilove 1980. Departures: the paper
// takes two operands at a time, leaf by leaf up the tree. Here the samples of
// all leaves are sorted together; each flips its leaf and the program is
// evaluated again along the path to the root, O(k log k + k·depth) for k
// samples however many leaves the scene has. Where samples tie, the paper says
// nothing; here they are one event (kTieDistance), so that the result is
// regularised: touching solids unite without an inner wall, and a difference
// with coplanar faces leaves no skin.

#include <cstdint>
#include <span>
#include <vector>

#include "csg/scene.h"
#include "ldni/image/sample.h"
#include "plane/program/program_state.h"

namespace lamina::ldni {

// Evaluates the program of a scene ray after ray. One object per thread.
class RayBoolean {
 public:
  explicit RayBoolean(const csg::Scene& scene);

  // Appends the intervals of one ray to `out`, ascending.
  //
  // samples  of all leaves, in any order; sorted here by depth, then by
  //          instance, so the result does not depend on their order.
  // Every leaf must be left as often as it is entered (checked).
  void evaluate(std::span<Sample> samples, std::vector<Interval>& out);

 private:
  void flip_leaf(const Sample& sample);

  plane::ProgramState program_;
  std::vector<std::int32_t> winding_;  // by instance; 0 between rays
  std::vector<bool> counts_winding_;   // by instance; else crossings toggle
};

}  // namespace lamina::ldni
