#include "slicer/slice/detail/layer_insets.h"

#include <algorithm>
#include <cmath>

#include "slicer/plan/orientation.h"

namespace lamina::slicer {
LayerInsets::LayerInsets(const csg::Scene& scene, const ldni::LayerGrid& grid,
                         const Settings& settings)
    : grid_(grid), everywhere_(settings.compensation), foot_(settings.foot) {
  if (foot_.inset == 0 || scene.box.is_empty()) return;
  const double lowest = lowest_point(scene);
  if (settings.heights.empty()) {
    first_layer_ = grid.layers_below(lowest);
    return;
  }
  thickness_ = settings.layer_thickness;
  const auto usual =
      ldni::LayerGrid::uniform(scene.box.low.z, scene.box.high.z, thickness_);
  bottom_ = usual.layer_bottom(usual.layers_below(lowest));
}

double LayerInsets::of(std::uint32_t layer) const {
  return foot_.inset == 0 ? everywhere_
                          : everywhere_ + foot_.of(number_of(layer));
}

std::uint32_t LayerInsets::number_of(std::uint32_t layer) const {
  if (thickness_ == 0) {
    return layer < first_layer_ ? 0 : layer - first_layer_;
  }
  const double number =
      std::floor((grid_.section_z(layer) - bottom_) / thickness_);
  return static_cast<std::uint32_t>(
      std::clamp(number, 0.0, double{kMostFootLayers}));
}

}  // namespace lamina::slicer
