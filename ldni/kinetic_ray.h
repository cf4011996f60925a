#pragma once
// The kinetic ray: the ray of a layer moves along x and carries its sorted
// samples; it stops only where their order can change (docs/design.md).

#include <cstdint>
#include <memory>

#include "csg/scene.h"
#include "ldni/contours.h"
#include "ldni/leaf_section.h"

namespace lamina::ldni {

// What a sweep met, added up over layers (`--report`).
struct SweepCounts {
  std::uint64_t layers = 0;
  std::uint64_t chains = 0;
  std::uint64_t points = 0;  // vertices of chains
  std::uint64_t slabs = 0;
  std::uint64_t stops = 0;
  std::uint64_t evaluations = 0;  // of sets by the Boolean program
  // Layers with faces nearer than a tie but not the same: their loops were
  // swept once more, see kinetic_ray.cpp.
  std::uint64_t resolved_layers = 0;
  std::uint64_t capped_columns = 0;    // bubbling reached its cap: always 0
  std::uint64_t repaired_columns = 0;  // I4 did not hold: always 0

  SweepCounts& operator+=(const SweepCounts& other);
};

// Turns the chains of a layer into the exact contours of the Boolean of the
// leaves. One object per thread: it owns the scratch that layers share.
class KineticRay {
 public:
  // pitch  distance of the look-ahead rays [mm]; 0 = auto. A speed knob only.
  KineticRay(const csg::Scene& scene, double pitch);
  ~KineticRay();
  KineticRay(const KineticRay&) = delete;
  KineticRay& operator=(const KineticRay&) = delete;

  // Replaces `contours` by the loops of layer `layer` of `block`.
  void sweep(const ChainBlock& block, std::uint32_t layer, Contours& contours);

  const SweepCounts& counts() const;

 private:
  struct State;
  struct Resolver;
  std::unique_ptr<State> state_;
  std::unique_ptr<Resolver> resolver_;
};

}  // namespace lamina::ldni
