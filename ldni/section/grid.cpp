#include "ldni/section/grid.h"

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

LayerGrid LayerGrid::stacked(double bottom, double unit,
                             const std::vector<std::uint32_t>& borders) {
  LayerGrid grid;
  for (std::size_t i = 0; i < borders.size(); ++i) {
    grid.borders_.push_back(bottom + borders[i] * unit);
    if (i == 0) continue;
    const double middle = 0.5 * borders[i - 1] + 0.5 * borders[i];
    grid.heights_.push_back(bottom + middle * unit);
  }
  grid.layer_count_ = static_cast<std::uint32_t>(grid.heights_.size());
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
  if (!borders_.empty()) return borders_[layer];
  if (thickness_ == 0) return heights_[layer];
  return bottom_ + layer * thickness_;
}

double LayerGrid::layer_top(std::uint32_t layer) const {
  if (!borders_.empty()) return borders_[layer + 1];
  if (thickness_ == 0) return heights_[layer];
  return bottom_ + (layer + 1.0) * thickness_;
}

double LayerGrid::threshold(std::uint32_t layer) const {
  return section_z(layer) + kOnPlaneDistance;
}

std::uint32_t LayerGrid::layers_below(double z) const {
  if (thickness_ == 0) {
    const auto it = std::partition_point(
        heights_.begin(), heights_.end(),
        [z](double height) { return height + kOnPlaneDistance < z; });
    return static_cast<std::uint32_t>(it - heights_.begin());
  }
  // Divide for a guess, then let the thresholds decide.
  const double guess = (z - bottom_) / thickness_ + 0.5;
  if (!(guess >= 0)) return 0;
  std::uint32_t layers =
      guess >= layer_count_ ? layer_count_ : static_cast<std::uint32_t>(guess);
  while (layers > 0 && !(z > threshold(layers - 1))) --layers;
  while (layers < layer_count_ && z > threshold(layers)) ++layers;
  return layers;
}

}  // namespace lamina::ldni
