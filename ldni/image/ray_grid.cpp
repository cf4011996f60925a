#include "ldni/image/ray_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lamina::ldni {
namespace {

// The share of a pitch at which rays lie: the fraction of the golden ratio,
// no multiple of which is near a round number.
constexpr double kRayShare = 0.61803398874989484820;

// Local boxes grow by this [mm]: the bounds of an instance and the vertices
// that a sampler computes may differ by rounding (1e-12 mm).
constexpr double kBoxMargin = 1e-6;

}  // namespace

RayGrid::RayGrid(double low_x, double high_x, double pitch)
    : origin_(low_x + kRayShare * pitch),
      pitch_(pitch),
      rays_per_mm_(1 / pitch) {
  const double count = std::ceil((high_x - origin_) / pitch);
  ray_count_ = static_cast<std::uint32_t>(std::clamp(
      count, 0.0,
      static_cast<double>(std::numeric_limits<std::int32_t>::max())));
}

GridBox global_box(const RayGrid& rays, const LayerGrid& layers) {
  return {0, rays.ray_count(), 0, layers.layer_count()};
}

GridBox local_box(const Box3& box, const RayGrid& rays,
                  const LayerGrid& layers) {
  if (box.is_empty()) return {};
  GridBox result;
  result.ray_start = rays.rays_below(box.low.x - kBoxMargin);
  result.ray_count =
      rays.rays_below(box.high.x + kBoxMargin) - result.ray_start;
  result.layer_start = layers.layers_below(box.low.z - kBoxMargin);
  result.layer_count =
      layers.layers_below(box.high.z + kBoxMargin) - result.layer_start;
  return result;
}

GridBox clip_to_layers(const GridBox& box, std::uint32_t first_layer,
                       std::uint32_t layer_count) {
  GridBox result = box;
  result.layer_start = std::max(box.layer_start, first_layer);
  const std::uint32_t end =
      std::min(box.layer_end(), first_layer + layer_count);
  result.layer_count = end > result.layer_start ? end - result.layer_start : 0;
  return result;
}

}  // namespace lamina::ldni
