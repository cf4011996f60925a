#include "slicer/check/leaf_search.h"

#include <algorithm>
#include <numeric>

#include "base/plane.h"
#include "csg/tie_distance.h"

namespace lamina::slicer {
namespace {

// Boundary lies where a chain does, or one that ties with it [mm].
constexpr double kSearchDistance = 2 * kTieDistance;

// Of chains as near but for this [mm], that of the first leaf counts.
constexpr double kSameDistance = 1e-9;

}  // namespace

void LeafSearch::find(const ldni::ChainBlock& block, std::uint32_t layer,
                      std::span<ThinStretch> stretches) {
  if (stretches.empty()) return;
  places_.clear();
  for (const ThinStretch& stretch : stretches) {
    places_.insert(places_.end(), stretch.sides.begin(), stretch.sides.end());
  }
  members_.resize(places_.size());
  std::iota(members_.begin(), members_.end(), 0U);
  grid_.fill(places_, members_);
  distances_.assign(places_.size(), kSearchDistance);
  instances_.assign(places_.size(), kNoInstance);

  // Chains come instance by instance, the first one first.
  std::uint32_t instance = kNoInstance;
  for (const ldni::Chain& chain : block.layer(layer)) {
    if (chain.instance != instance) look_between_endpoints(instance);
    instance = chain.instance;
    const std::span<const Vec2> points = chain.points_in(block.points);
    for (std::size_t i = 1; i < points.size(); ++i) {
      look_along(points[i - 1], points[i], instance);
    }
    endpoints_.push_back(points.front());
    endpoints_.push_back(points.back());
  }
  look_between_endpoints(instance);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    stretches[i / 2].instances[i % 2] = instances_[i];
  }
}

// Upright edges belong to no chain: they stand between endpoints of chains at
// one x, which pair up from below.
void LeafSearch::look_between_endpoints(std::uint32_t instance) {
  std::ranges::sort(endpoints_, precedes);
  for (std::size_t i = 1; i < endpoints_.size(); i += 2) {
    if (endpoints_[i].y > endpoints_[i - 1].y) {
      look_along(endpoints_[i - 1], endpoints_[i], instance);
    }
  }
  endpoints_.clear();
}

void LeafSearch::look_along(Vec2 from, Vec2 to, std::uint32_t instance) {
  grid_.has_near(from, to, kSearchDistance, [&](std::uint32_t i) {
    const double away = distance_to_segment(places_[i], from, to);
    if (away < distances_[i] - kSameDistance) {
      distances_[i] = away;
      instances_[i] = instance;
    }
    return false;  // look at all
  });
}

}  // namespace lamina::slicer
