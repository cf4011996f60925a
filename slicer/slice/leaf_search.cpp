#include "slicer/slice/leaf_search.h"

#include <algorithm>
#include <numeric>

#include "plane/predicates.h"
#include "plane/tie_distance.h"
#include "slicer/check/thin/thin_finder.h"

namespace lamina::slicer {
namespace {

// Boundary lies where a chain does, or one that ties with it [mm].
constexpr double kSearchDistance = 2 * kTieDistance;

// Among chains whose distances differ by less than this [mm], that of the first
// leaf counts.
constexpr double kSameDistance = 1e-9;

}  // namespace

std::span<const std::uint32_t> LeafSearch::find(const plane::ChainBlock& block,
                                                std::uint32_t layer,
                                                std::span<const Vec2> places) {
  instances_.assign(places.size(), kNoInstance);
  if (places.empty()) return instances_;
  places_ = places;
  members_.resize(places.size());
  std::iota(members_.begin(), members_.end(), 0U);
  grid_.fill(places, members_);
  distances_.assign(places.size(), kSearchDistance);

  // Chains come instance by instance, the first one first.
  std::uint32_t instance = kNoInstance;
  for (const plane::Chain& chain : block.layer(layer)) {
    if (chain.operand != instance) look_between_endpoints(instance);
    instance = chain.operand;
    const std::span<const Vec2> points = chain.points_in(block.points);
    for (std::size_t i = 1; i < points.size(); ++i) {
      look_along(points[i - 1], points[i], instance);
    }
    endpoints_.push_back(points.front());
    endpoints_.push_back(points.back());
  }
  look_between_endpoints(instance);
  return instances_;
}

// Upright edges belong to no chain: they join endpoints of chains at one x,
// which pair up from below.
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
