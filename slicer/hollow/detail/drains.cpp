#include "slicer/hollow/detail/drains.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "plane/predicates.h"

namespace lamina::slicer::detail {
namespace {

// Walls up to so much thicker than the thinnest are about as thin [share, mm].
constexpr double kThinShare = 1.25;
constexpr double kThinExtra = 0.05;

// A way through the wall, level.
struct Way {
  Vec2 inside = Vec2(0);
  Vec2 outside = Vec2(0);
  double length = 0;
};

// The ways from points of a region's outline, no farther apart than `step`.
void add_ways(const plane::Region& region, std::size_t layer,
              const LayerSolids& part, double step, std::vector<Way>& ways) {
  for (const plane::Contour& contour : region.contours) {
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const Vec2 from = contour[i];
      const Vec2 to = contour[(i + 1) % contour.size()];
      const int parts = 1 + static_cast<int>(glm::length(to - from) / step);
      for (int k = 0; k < parts; ++k) {
        const Vec2 inside = from + (to - from) * (double(k) / parts);
        const Vec2 outside = part.nearest(layer, inside);
        ways.push_back({inside, outside, glm::length(outside - inside)});
      }
    }
  }
}

std::vector<Way> ways_at(const Cavity& cavity, double z,
                         const LayerSolids& part, double step,
                         std::size_t& layer) {
  const auto nearest =
      std::ranges::min_element(cavity.layers, {}, [&](const CavityLayer& one) {
        return std::abs(part.layer(one.layer).section_z - z);
      });
  layer = nearest->layer;
  std::vector<Way> ways;
  for (const CavityLayer& one : cavity.layers) {
    if (one.layer == layer) add_ways(one.region, layer, part, step, ways);
  }
  return ways;
}

// Half a diameter longer on both sides, so that its whole width is through.
Drain along(Vec3 inside, Vec3 outside, double diameter) {
  const Vec3 reach = diameter / 2 * glm::normalize(outside - inside);
  return {inside - reach, outside + reach, diameter};
}

Drain along(const Way& way, double z, double diameter) {
  return along(Vec3(way.inside, z), Vec3(way.outside, z), diameter);
}

// The point of a region that is nearest to a place.
Vec2 nearest_in(const plane::Region& region, Vec2 place) {
  int winding = 0;
  Vec2 nearest = place;
  double distance = std::numeric_limits<double>::infinity();
  for (const plane::Contour& contour : region.contours) {
    winding += winding_number(contour, place);
    for (std::size_t k = 0; k < contour.size(); ++k) {
      const Vec2 from = contour[k];
      const Vec2 to = contour[(k + 1) % contour.size()];
      const Vec2 point = from + (to - from) * nearest_share(place, from, to);
      if (glm::length(point - place) >= distance) continue;
      distance = glm::length(point - place);
      nearest = point;
    }
  }
  return winding > 0 ? place : nearest;
}

}  // namespace

std::vector<Drain> choose_drains(const Cavity& cavity, const LayerSolids& part,
                                 double diameter) {
  const double low = part.layer(cavity.layers.front().layer).bottom;
  const double high = part.layer(cavity.layers.back().layer).top;
  const double in = std::min(diameter, high - low) / 2;
  const double step = diameter / 2;
  std::size_t layer = 0;
  const std::vector<Way> low_ways =
      ways_at(cavity, low + in, part, step, layer);
  const Way& first = *std::ranges::min_element(low_ways, {}, &Way::length);
  std::vector<Drain> drains = {
      along(first, part.layer(layer).section_z, diameter)};
  const std::vector<Way> high_ways =
      ways_at(cavity, high - in, part, step, layer);
  const double thin =
      kThinShare *
          std::ranges::min_element(high_ways, {}, &Way::length)->length +
      kThinExtra;
  const Way& second =
      *std::ranges::max_element(high_ways, {}, [&](const Way& way) {
        return way.length > thin ? -1
                                 : glm::length(way.outside - first.outside);
      });
  drains.push_back(along(second, part.layer(layer).section_z, diameter));
  return drains;
}

NearestCavity find_nearest(Vec3 place, std::span<const Cavity> cavities,
                           const LayerSolids& part) {
  NearestCavity best;
  best.distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < cavities.size(); ++i) {
    for (const CavityLayer& one : cavities[i].layers) {
      const double z = part.layer(one.layer).section_z;
      if (std::abs(z - place.z) >= best.distance) continue;
      const Vec3 point(nearest_in(one.region, Vec2(place)), z);
      const double distance = glm::length(point - place);
      if (distance < best.distance) best = {i, point, distance};
    }
  }
  return best;
}

Drain drain_from(const DrainPlace& place, Vec3 point) {
  return along(point, place.place, place.diameter);
}

}  // namespace lamina::slicer::detail
