#include "slicer/picture/detail/support_places.h"

#include "base/parallel.h"

namespace lamina::slicer {
namespace {

// What is no farther outside the part is on it: contours of the whole and of
// the part differ by twice the usual tolerance of simplification [mm].
constexpr double kOnPart = 0.002;

// Places of the layer are on one of both, or nearly so [mm].
constexpr double kReach = 0.1;

}  // namespace

SupportPlaces::SupportPlaces(const std::vector<Layer>& layers) {
  std::vector<std::size_t> with_supports;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    if (layers[i].supports.is_empty()) continue;
    depths_of_.resize(layers.size());
    with_supports.push_back(i);
    depths_of_[i] = with_supports.size();
  }
  depths_.resize(with_supports.size());
  for_each_index(with_supports.size(), [&](std::size_t i) {
    const Layer& layer = layers[with_supports[i]];
    depths_[i] = {LayerDistance(layer.part, kReach),
                  LayerDistance(layer.supports, kReach)};
  });
}

bool SupportPlaces::hold(std::size_t layer, Vec2 place) const {
  if (depths_of_.empty() || depths_of_[layer] == 0) return false;
  const Depths& depths = depths_[depths_of_[layer] - 1];
  const double in_part = depths.part.at(place).depth;
  return in_part < -kOnPart && depths.supports.at(place).depth > in_part;
}

}  // namespace lamina::slicer
