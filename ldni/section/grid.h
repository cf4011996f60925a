#pragma once
// Heights of the sections.
//
// Sections stand at z_k = bottom + (k + 1/2)·thickness, by multiplication, in
// the middle of layers of several units each, or at heights given one by one.
// One rule decides for every sampler whether a vertex is above a section: it is
// where z > threshold(section). Comparing with one threshold and counting
// layers are the same decision bit by bit, so that a sampler may do either.

#include <cstdint>
#include <vector>

#include "csg/scene.h"

namespace lamina::ldni {

// Heights of all sections of a job, ascending.
class LayerGrid {
 public:
  // Layers of equal thickness [mm] that cover [bottom, top].
  static LayerGrid uniform(double bottom, double top, double thickness);
  // Layers from border to border, which are counted in units [mm] from the
  // bottom and rise.
  static LayerGrid stacked(double bottom, double unit,
                           const std::vector<std::uint32_t>& borders);
  // Sections at exactly these heights (ascending, checked by the caller).
  static LayerGrid at_heights(std::vector<double> heights);

  std::uint32_t layer_count() const;
  // Of each layer; 0 where they differ or have none.
  double thickness() const { return thickness_; }
  double section_z(std::uint32_t layer) const;
  double layer_bottom(std::uint32_t layer) const;  // = section_z for heights
  double layer_top(std::uint32_t layer) const;

  // What a vertex must be higher than to be above the section: the section's
  // height and kOnPlaneDistance (1e-9 mm). A vertex on the section counts as
  // below, so a solid fills [bottom, top). Ascends with the layer.
  double threshold(std::uint32_t layer) const;

  // Number of sections that a vertex at height z is above of: layers_below(z)
  // > l exactly where z > threshold(l). Nothing else ever decides this.
  std::uint32_t layers_below(double z) const;

 private:
  double bottom_ = 0;
  double thickness_ = 0;  // 0: heights_ rules
  std::uint32_t layer_count_ = 0;
  std::vector<double> heights_;
  std::vector<double> borders_;  // of stacked layers, one more than layers
};

}  // namespace lamina::ldni
