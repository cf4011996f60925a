#pragma once
// What a cascade makes of layers, and what that costs.

#include <span>
#include <vector>

#include "csg/scene.h"
#include "plane/cascade/cascade.h"
#include "plane/chains.h"
#include "plane/contours.h"
#include "plane/sweep/sweep_options.h"

namespace lamina::testing {

// With so much patience a cascade sweeps all in one go.
inline constexpr double kPatient = 1e9;

struct Swept {
  std::vector<plane::Contours> layers;
  plane::SweepCounts counts;
};

// Sweeps the layers of a scene, one after the other, by one cascade.
inline Swept sweep(const csg::Scene& scene,
                   std::span<const plane::LayerChains> layers,
                   double patience) {
  const plane::BooleanProgram program = csg::program_of(scene);
  plane::Cascade cascade(program, {}, patience);
  Swept swept;
  for (const plane::LayerChains& layer : layers) {
    cascade.sweep(layer, swept.layers.emplace_back());
  }
  swept.counts = cascade.counts();
  return swept;
}

}  // namespace lamina::testing
