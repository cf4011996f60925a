#pragma once
// Heights of the sections and, for rays, positions in x.
//
// Layers stand at z_k = bottom + (k + 1/2)·thickness, by multiplication, or at
// heights given one by one. One rule decides which layers a vertex reaches,
// for every sampler: `layers_below`.

#include <cstdint>
#include <vector>

#include "csg/scene.h"

namespace lamina::ldni {

// Heights of all sections of a job, ascending.
class LayerGrid {
 public:
  // Layers of equal thickness [mm] that cover [bottom, top].
  static LayerGrid uniform(double bottom, double top, double thickness);
  // Sections at exactly these heights (ascending, checked by the caller).
  static LayerGrid at_heights(std::vector<double> heights);

  std::uint32_t layer_count() const;
  double section_z(std::uint32_t layer) const;
  double layer_bottom(std::uint32_t layer) const;  // = section_z for heights
  double layer_top(std::uint32_t layer) const;

  // Number of sections lower than z by more than kOnPlaneDistance (1e-9 mm): a
  // vertex at height z is above section l if layers_below(z) > l. A vertex on
  // the section counts as below, so a solid fills [bottom, top). Nothing else
  // ever decides this.
  std::uint32_t layers_below(double z) const;

 private:
  double bottom_ = 0;
  double thickness_ = 0;  // 0: heights_ rules
  std::uint32_t layer_count_ = 0;
  std::vector<double> heights_;
};

}  // namespace lamina::ldni
