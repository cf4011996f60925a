#include "slicer/hollow/detail/closing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "base/parallel.h"
#include "plane/region/boolean.h"
#include "plane/region/offset.h"

namespace lamina::slicer::detail {
namespace {

// Angles above and below the ball's equator at which it is sampled, in steps of
// this [degrees]. Between two samples the higher one counts, which is no more
// than half a step, in radians, of the radius away: 9 %.
constexpr int kStepDeg = 10;
constexpr int kGreatestDeg = 80;

// Of round joins, as a share of the radius.
constexpr double kArcShare = 0.01;

// Layers above a core that the ball meets, and how wide it is there [mm].
struct Level {
  std::ptrdiff_t layers = 0;
  double radius = 0;
};

std::vector<Level> levels_of(double radius, double thickness) {
  std::vector<Level> levels;
  for (int angle = -kGreatestDeg; angle <= kGreatestDeg; angle += kStepDeg) {
    const double z = radius * std::sin(angle * std::numbers::pi / 180);
    const auto layers = static_cast<std::ptrdiff_t>(std::lround(z / thickness));
    const double rise = static_cast<double>(layers) * thickness;
    if (std::abs(rise) >= radius) continue;
    if (!levels.empty() && levels.back().layers == layers) continue;
    levels.push_back({layers, std::sqrt(radius * radius - rise * rise)});
  }
  return levels;
}

}  // namespace

std::vector<Layer> dilate(std::span<const Layer> cores,
                          std::span<const Layer> layers, double radius) {
  const double thickness = layers.front().top - layers.front().bottom;
  const std::vector<Level> levels = levels_of(radius, thickness);
  // By layer of the part, what each core gives to it.
  std::vector<std::vector<plane::Region>> given(layers.size());
  std::vector<std::vector<plane::Region>> grown(cores.size());
  for_each_index(cores.size(), [&](std::size_t i) {
    const plane::Region core = plane::to_region(cores[i].contours);
    for (const Level& level : levels) {
      grown[i].push_back(plane::offset(core, level.radius, plane::Join::kRound,
                                       kArcShare * radius));
    }
  });
  for (std::size_t i = 0; i < cores.size(); ++i) {
    const auto same = std::ranges::lower_bound(
        layers, cores[i].section_z - thickness / 2, {}, &Layer::section_z);
    for (std::size_t k = 0; k < levels.size(); ++k) {
      const std::ptrdiff_t at = (same - layers.begin()) + levels[k].layers;
      if (at < 0 || at >= std::ssize(layers)) continue;
      given[static_cast<std::size_t>(at)].push_back(std::move(grown[i][k]));
    }
  }
  std::vector<Layer> dilated(layers.size());
  for_each_index(layers.size(), [&](std::size_t i) {
    dilated[i].section_z = layers[i].section_z;
    dilated[i].bottom = layers[i].bottom;
    dilated[i].top = layers[i].top;
    dilated[i].contours = plane::to_contours(plane::unite(given[i]));
  });
  std::erase_if(dilated,
                [](const Layer& layer) { return layer.contours.is_empty(); });
  return dilated;
}

}  // namespace lamina::slicer::detail
