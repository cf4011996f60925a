#include "ldni/grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lamina::ldni {
namespace {

// A vertex this near to a section [mm] counts as on it, hence as below. Large
// against the rounding of a rotated coordinate (1e-12 mm at 1e4 mm), small
// against any feature (kTieDistance is 1e-6 mm).
constexpr double kOnPlaneDistance = 1e-9;

}  // namespace

LayerGrid LayerGrid::uniform(double bottom, double top, double thickness) {
  LayerGrid grid;
  grid.bottom_ = bottom;
  grid.thickness_ = thickness;
  const double count = std::ceil((top - bottom) / thickness - 0.5);
  grid.layer_count_ = static_cast<std::uint32_t>(std::clamp(
      count, 0.0,
      static_cast<double>(std::numeric_limits<std::int32_t>::max())));
  return grid;
}

LayerGrid LayerGrid::at_heights(std::vector<double> heights) {
  LayerGrid grid;
  grid.layer_count_ = static_cast<std::uint32_t>(heights.size());
  grid.heights_ = std::move(heights);
  return grid;
}

std::uint32_t LayerGrid::layer_count() const { return layer_count_; }

double LayerGrid::section_z(std::uint32_t layer) const {
  if (thickness_ == 0) return heights_[layer];
  return bottom_ + (layer + 0.5) * thickness_;
}

double LayerGrid::layer_bottom(std::uint32_t layer) const {
  if (thickness_ == 0) return heights_[layer];
  return bottom_ + layer * thickness_;
}

double LayerGrid::layer_top(std::uint32_t layer) const {
  if (thickness_ == 0) return heights_[layer];
  return bottom_ + (layer + 1.0) * thickness_;
}

std::uint32_t LayerGrid::layers_below(double z) const {
  if (thickness_ == 0) {
    const auto it = std::lower_bound(heights_.begin(), heights_.end(),
                                     z - kOnPlaneDistance);
    return static_cast<std::uint32_t>(it - heights_.begin());
  }
  const double sections =
      std::ceil((z - (bottom_ + 0.5 * thickness_)) / thickness_ -
                kOnPlaneDistance / thickness_);
  if (!(sections > 0)) return 0;
  if (sections >= layer_count_) return layer_count_;
  return static_cast<std::uint32_t>(sections);
}

}  // namespace lamina::ldni
