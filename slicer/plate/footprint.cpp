#include "slicer/plate/footprint.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "base/parallel.h"
#include "plane/region/boolean.h"
#include "plane/region/offset.h"
#include "slicer/contour/simplify.h"

namespace lamina::slicer {
namespace {

plane::Region simplify(plane::Contours contours, double tolerance) {
  Simplifier(tolerance).simplify(contours);
  return plane::to_region(contours);
}

// The cosine and the sine of the angle.
Vec2 direction_of(double turn_deg) {
  const double quarters = turn_deg / 90;
  if (quarters == std::floor(quarters)) {
    constexpr double kSines[] = {0, 1, 0, -1};
    const auto quarter =
        static_cast<std::size_t>(std::fmod(std::fmod(quarters, 4) + 4, 4));
    return {kSines[(quarter + 1) % 4], kSines[quarter]};
  }
  const double angle = turn_deg * std::numbers::pi / 180;
  return {std::cos(angle), std::sin(angle)};
}

// The union of layers that are simplified before, and once more itself.
plane::Region unite_batch(std::span<const plane::Contours* const> layers,
                          double tolerance) {
  std::vector<plane::Region> regions;
  for (const plane::Contours* layer : layers) {
    regions.push_back(simplify(*layer, tolerance));
  }
  return simplify(plane::to_contours(plane::unite(regions)), tolerance);
}

}  // namespace

plane::Region footprint_of(std::span<const Layer> layers, double tolerance) {
  // Neighbours are often the same, of a prism all.
  std::vector<const plane::Contours*> different;
  for (const Layer& layer : layers) {
    if (layer.contours.is_empty()) continue;
    if (!different.empty() && *different.back() == layer.contours) continue;
    different.push_back(&layer.contours);
  }
  if (different.empty()) return {};
  const std::size_t per_batch =
      static_cast<std::size_t>(std::sqrt(different.size())) + 1;
  std::vector<plane::Region> batches((different.size() + per_batch - 1) /
                                     per_batch);
  for_each_index(batches.size(), [&](std::size_t i) {
    const auto rest = std::span(different).subspan(i * per_batch);
    batches[i] = unite_batch(rest.first(std::min(rest.size(), per_batch)),
                             tolerance / 4);
  });
  // Both times a border moved by no more than a quarter of the tolerance. The
  // steps of a round join lie inside of its arc by no more than another.
  return plane::offset(plane::unite(batches), tolerance, plane::Join::kRound,
                       tolerance / 4);
}

PlateMotion::PlateMotion(double turn_deg, Vec2 shift)
    : x_axis_(direction_of(turn_deg)), shift_(shift) {}

plane::Region place(const plane::Region& region, double turn_deg, Vec2 shift) {
  const PlateMotion motion(turn_deg, shift);
  plane::Region placed = region;
  for (plane::Contour& contour : placed.contours) {
    for (Vec2& p : contour) p = motion(p);
  }
  return placed;
}

}  // namespace lamina::slicer
