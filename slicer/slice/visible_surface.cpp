#include "slicer/slice/visible_surface.h"

#include <algorithm>
#include <utility>

#include "slicer/slice/scene_parts.h"
#include "slicer/slice/slice.h"

namespace lamina::slicer {

VisibleSurface::VisibleSurface(std::vector<Layer> layers)
    : layers_(std::move(layers)), solids_(layers_) {}

std::optional<VisibleSurface> VisibleSurface::of(
    const csg::Scene& scene, std::span<const Layer> layers) {
  const auto leaves =
      leaves_of(scene, [](const csg::Instance& one) { return one.is_visible; });
  if (!leaves) return std::nullopt;
  Settings settings;
  for (const Layer& layer : layers) settings.heights.push_back(layer.section_z);
  return VisibleSurface(all_layers(*leaves, settings));
}

bool VisibleSurface::is_at(Vec3 place) const {
  if (layers_.empty()) return false;
  const auto above =
      std::ranges::lower_bound(layers_, place.z, {}, &Layer::section_z);
  const auto i = std::min(static_cast<std::size_t>(above - layers_.begin()),
                          layers_.size() - 1);
  return solids_.touches(i, Vec2(place));
}

}  // namespace lamina::slicer
