#pragma once
// The kinetic ray: exact contours of a Boolean of leaves, at any pitch.
//
// A row of rays, each with its own Boolean, sees a layer at the pitch: it loses
// what is thinner and parallel to the rays, and cuts corners off. That is the
// open problem of Zeng et al. 2011. Here one ray sweeps along x (Bentley and
// Ottmann 1979) and carries its sorted samples, one of each chain that it
// crosses. Their order, and with it the value of the Boolean in every gap,
// changes only at event points: where a chain begins or ends, where two chains
// cross, and where they begin or cease to coincide. The 1D Boolean left and
// right of an event point differ in intervals of y, and these are the boundary
// that lies in the ray. All other boundary is parts of chains between two
// event points. So topology and corners are exact, whatever the pitch: rays at
// the pitch remain as the places up to which the ray looks ahead.
//
// Nothing is computed anew at an event point: neighbours swap, states of the
// Boolean program change from the swap upwards until they are what they were,
// and a state is known once it was met. The cost is that of the changes, not of
// the leaves on the ray. Where solids overlap so much that most changes are
// hidden, the layer is swept in groups (plane/cascade/cascade.h).
//
// Faces that coincide up to rounding tie: samples nearer than kTieDistance
// between two vertices are one curve, of which only the solid below and above
// counts. So solids that touch unite without an inner wall, and a difference
// with coplanar faces leaves no skin. Faces that are apart by less than that,
// but not by rounding, may leave boundary that runs into itself by as much;
// those layers are found, and their loops swept once more with ties of 1e-9 mm.
//
// The order of work and the invariants: plane/sweep/ray_sweep.h.

#include <cstdint>
#include <memory>

#include "plane/chains.h"
#include "plane/contours.h"
#include "plane/program/boolean_program.h"
#include "plane/sweep/sweep_options.h"

namespace lamina::plane {

class Cascade;

// Turns the chains of a layer into the exact contours of the Boolean of the
// leaves. One object per thread: it owns the scratch that layers share.
class KineticRay {
 public:
  // The program must outlive the object.
  explicit KineticRay(const BooleanProgram& program,
                      const SweepOptions& options = {});
  explicit KineticRay(BooleanProgram&&, const SweepOptions& = {}) = delete;
  ~KineticRay();

  // Replaces `contours` by the loops of layer `layer` of `block`.
  void sweep(const ChainBlock& block, std::uint32_t layer, Contours& contours);

  SweepCounts counts() const;

 private:
  std::unique_ptr<Cascade> cascade_;
};

}  // namespace lamina::plane
