#pragma once
// What a cascade makes of layers, and what that costs.

#include <span>
#include <vector>

#include "csg/scene.h"
#include "ldni/section/chains.h"
#include "ldni/section/contours.h"
#include "ldni/sweep/detail/cascade.h"
#include "ldni/sweep/sweep_options.h"

namespace lamina::testing {

// With so much patience a cascade sweeps all in one go.
inline constexpr double kPatient = 1e9;

struct Swept {
  std::vector<ldni::Contours> layers;
  ldni::SweepCounts counts;
};

// Sweeps the layers of a scene, one after the other, by one cascade.
inline Swept sweep(const csg::Scene& scene,
                   std::span<const ldni::LayerChains> layers, double patience) {
  ldni::detail::Cascade cascade(scene, {}, patience);
  Swept swept;
  for (const ldni::LayerChains& layer : layers) {
    cascade.sweep(layer, swept.layers.emplace_back());
  }
  swept.counts = cascade.counts();
  return swept;
}

}  // namespace lamina::testing
