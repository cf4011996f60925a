#include "plane/sweep/ray_sweep.h"

#include <algorithm>
#include <cmath>

namespace lamina::plane {
namespace {

constexpr double kMostSlabsOfPitch = 1 << 16;

}  // namespace

bool RaySweep::resume(Contours& contours, const Patience& patience) {
  const auto is_too_much = [&] {
    return swaps() >
           patience.swaps_per_chain * chains_met() + patience.first_swaps;
  };
  while (is_in_cluster_ || next_endpoint_ < endpoints_.size()) {
    if (!is_in_cluster_) {
      begin_cluster(order_.next_event_point(endpoints_[next_endpoint_].x));
    }
    // Thousands of chains that coincide begin at once.
    for (; next_begun_ < begun_.size(); ++next_begun_) {
      if (is_too_much()) return false;
      insert(begun_[next_begun_]);
    }
    finish_cluster();
    if (is_too_much()) return false;
  }
  boundary_.write_loops(contours);
  return true;
}

bool RaySweep::step() {
  if (next_endpoint_ == endpoints_.size()) return false;
  begin_cluster(order_.next_event_point(endpoints_[next_endpoint_].x));
  for (const std::uint32_t chain : begun_) insert(chain);
  finish_cluster();
  return true;
}

SweepCounts RaySweep::counts() const {
  SweepCounts counts = counts_;
  counts.unbalanced_clusters = boundary_.unbalanced_clusters();
  counts.repaired_clusters = boundary_.unlinked_ends();
  counts.capped_clusters = order_.capped_clusters();
  return counts;
}

void RaySweep::begin(const LayerChains& layer, ProgramStates& states) {
  points_ = layer.points;
  chains_ = layer.chains;
  states_ = &states;
  lone_loops_.find(layer, states);
  endpoints_ = sorter_.sort(chains_, points_, lone_loops_);
  next_endpoint_ = 0;
  is_in_cluster_ = false;
  boundary_.begin_layer(states);
  std::size_t point_count = 0;
  for (const Chain& chain : chains_) point_count += chain.point_count;
  if (endpoints_.empty()) return;
  const double low = endpoints_.front().x;
  const double high = endpoints_.back().x;
  const std::uint32_t slabs = slab_count(high - low, point_count);
  order_.begin_layer(chains_.size(), low, high, slabs);
  counts_.slabs += slabs;
}

std::uint32_t RaySweep::slab_count(double width,
                                   std::size_t point_count) const {
  if (pitch_ == 0) return slab_count_of(point_count);
  const double count = std::clamp(width / pitch_, 1.0, kMostSlabsOfPitch);
  return static_cast<std::uint32_t>(std::ceil(count));
}

// All but the chains that begin.
void RaySweep::begin_cluster(double x) {
  is_in_cluster_ = true;
  ++counts_.event_points;
  order_.begin_cluster(x);
  boundary_.begin_cluster(order_.cluster());
  const std::span<const ChainEndpoint> endpoints = next_endpoints();
  // Around lone loops the cluster changes nothing, so the order on its left
  // will do for them.
  for (const ChainEndpoint& endpoint : endpoints) {
    if (lone_loops_.is_lone(endpoint.chain())) pass_lone_loop(endpoint.chain());
  }
  take(endpoints);
}

void RaySweep::finish_cluster() {
  order_.settle();
  boundary_.update(order_.cluster(), order_.changes());
  is_in_cluster_ = false;
}

// Those inside the cluster.
std::span<const ChainEndpoint> RaySweep::next_endpoints() {
  const double end = order_.cluster().end();
  const std::size_t first = next_endpoint_;
  while (next_endpoint_ < endpoints_.size() &&
         endpoints_[next_endpoint_].x <= end) {
    ++next_endpoint_;
  }
  return endpoints_.subspan(first, next_endpoint_ - first);
}

void RaySweep::pass_lone_loop(std::uint32_t chain) {
  const std::uint32_t lower = lone_loops_.is_lower(chain) ? chain : chain + 1;
  const std::uint32_t upper = lone_loops_.is_lower(chain) ? chain + 1 : chain;
  boundary_.add_lone_loop(chains_[lower], chains_[upper], points_);
}

// Removes the chains that end and lists those that begin. Chains that begin and
// end inside the cluster are passed over.
void RaySweep::take(std::span<const ChainEndpoint> endpoints) {
  const double end = order_.cluster().end();
  begun_.clear();
  next_begun_ = 0;
  for (const ChainEndpoint& endpoint : endpoints) {
    const std::uint32_t chain = endpoint.chain();
    if (lone_loops_.is_lone(chain)) continue;
    order_.take_endpoint(endpoint.x);
    if (!endpoint.is_right()) {
      if (points_of(chain).back().x > end) begun_.push_back(chain);
    } else if (order_.status().is_alive(chain)) {
      boundary_.end_chain(chain);
      order_.remove(chain);
    }
  }
}

void RaySweep::insert(std::uint32_t chain) {
  order_.insert(
      chain, points_of(chain),
      states_->crossing_of(chains_[chain].operand, chains_[chain].winding));
}

}  // namespace lamina::plane
