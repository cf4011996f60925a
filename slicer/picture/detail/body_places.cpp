#include "slicer/picture/detail/body_places.h"

#include "base/parallel.h"

namespace lamina::slicer {
namespace {

// What is no farther outside of a body is on it: contours of the whole and of
// the body differ by twice the usual tolerance of simplification [mm].
constexpr double kOnBody = 0.002;

// Places of the layer are on a body, or nearly so [mm].
constexpr double kReach = 0.1;

}  // namespace

BodyPlaces::BodyPlaces(const std::vector<Layer>& layers)
    : depths_(layers.size()) {
  for_each_index(layers.size(), [&](std::size_t i) {
    const Layer& layer = layers[i];
    Depths& depths = depths_[i];
    depths.has_supports = !layer.supports.is_empty();
    if (depths.has_supports) {
      depths.part = LayerDistance(layer.part, kReach);
      depths.supports = LayerDistance(layer.supports, kReach);
    }
    for (const ColoredPart& part : layer.colored) {
      if (part.contours.is_empty()) continue;
      depths.colored.emplace_back(part.color,
                                  LayerDistance(part.contours, kReach));
    }
  });
}

bool BodyPlaces::is_of_support(std::size_t layer, Vec2 place) const {
  const Depths& depths = depths_[layer];
  if (!depths.has_supports) return false;
  const double in_part = depths.part.at(place).depth;
  return in_part < -kOnBody && depths.supports.at(place).depth > in_part;
}

std::optional<std::int32_t> BodyPlaces::color_at(std::size_t layer,
                                                 Vec2 place) const {
  std::optional<std::int32_t> color;
  double deepest = -kOnBody;
  for (const auto& [own, distance] : depths_[layer].colored) {
    const double depth = distance.at(place).depth;
    if (depth < deepest || (color && depth == deepest)) continue;
    deepest = depth;
    color = own;
  }
  return color;
}

}  // namespace lamina::slicer
