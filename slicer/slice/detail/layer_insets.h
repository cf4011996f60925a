#pragma once
// How far the contours of each layer of a job are moved inwards.
//
// The foot begins at the first layer of the print, not of the grid: leaves may
// reach below the solid. Sections at given heights get what the layer of usual
// thickness has that they lie in, so that a comparison can cut a design at some
// heights of a print.

#include <cstdint>

#include "csg/scene.h"
#include "ldni/section/grid.h"
#include "slicer/slice/settings.h"

namespace lamina::slicer {

class LayerInsets {
 public:
  // scene, grid  the grid must outlive it
  LayerInsets(const csg::Scene& scene, const ldni::LayerGrid& grid,
              const Settings& settings);

  // Of a layer of the grid [mm]; negative: outwards.
  double of(std::uint32_t layer) const;

 private:
  // The layer of the print, from 0.
  std::uint32_t number_of(std::uint32_t layer) const;

  const ldni::LayerGrid& grid_;
  const double everywhere_;
  const Foot foot_;
  std::uint32_t first_layer_ = 0;  // of the print
  // Of given heights: where the first layer would begin, and how thick layers
  // are [mm].
  double bottom_ = 0;
  double thickness_ = 0;
};

}  // namespace lamina::slicer
