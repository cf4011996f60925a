#include "plane/sweep/gap_sweep.h"

namespace lamina::plane {
namespace {

// Chains of two sets cross less often than those of a Boolean's operands, so
// longer looks ahead pay: so many points count as one.
constexpr std::size_t kPointsPerPointOfABoolean = 4;

}  // namespace

void GapSweep::sweep(const LayerChains& layer, GapVisitor& visitor) {
  layer_ = layer;
  visitor_ = &visitor;
  endpoints_ = sorter_.sort(layer.chains, layer.points);
  next_endpoint_ = 0;
  if (endpoints_.empty()) return;
  order_.begin_layer(
      layer.chains.size(), endpoints_.front().x, endpoints_.back().x,
      slab_count_of(layer.points.size() / kPointsPerPointOfABoolean));
  gaps_.assign(layer.chains.size() + 1, {});
  while (next_endpoint_ < endpoints_.size()) {
    order_.begin_cluster(order_.next_event_point(endpoints_[next_endpoint_].x));
    take_endpoints();
    order_.settle();
    renew_gaps();
  }
}

// Chains that begin and end inside the cluster are passed over.
void GapSweep::take_endpoints() {
  const double end = order_.cluster().end();
  begun_.clear();
  for (; next_endpoint_ < endpoints_.size() &&
         endpoints_[next_endpoint_].x <= end;
       ++next_endpoint_) {
    const ChainEndpoint& endpoint = endpoints_[next_endpoint_];
    const std::uint32_t chain = endpoint.chain();
    order_.take_endpoint(endpoint.x);
    if (!endpoint.is_right()) {
      if (points_of(chain).back().x > end) begun_.push_back(chain);
    } else if (order_.status().is_alive(chain)) {
      close(gaps_[chain], order_.cluster().left);
      order_.remove(chain);
    }
  }
  for (const std::uint32_t chain : begun_) {
    order_.insert(chain, points_of(chain), 0);
  }
}

// Renews the gaps above the entries that the cluster has changed and, where
// their faces are not what they were, those above them. From the bottom up, so
// that no face follows from one that is about to change.
void GapSweep::renew_gaps() {
  Status& status = order_.status();
  doubtful_.clear();
  for (const std::uint32_t entry : order_.changes().unsure) {
    if (!status[entry].is_stale) order_.changes().stale.push_back(entry);
    status[entry].is_stale = true;
  }
  for (const std::uint32_t entry : order_.changes().stale) {
    if (!status.is_alive(entry)) continue;
    doubtful_.push_back({status.y_at(entry, order_.cluster().right), entry});
  }
  std::sort(doubtful_.begin(), doubtful_.end());
  for (auto [y, entry] : doubtful_) {
    if (!status[entry].is_stale) continue;
    while (status[status[entry].below].is_stale &&
           status[entry].below != status.sentinel()) {
      entry = status[entry].below;
    }
    // What is above an entry in doubt has had another one below it.
    for (bool goes_on = true; goes_on && entry != status.sentinel();
         entry = status[entry].above) {
      const bool is_in_doubt = status[entry].is_stale;
      goes_on = renew_gap(entry) || is_in_doubt;
    }
  }
}

// Whether the faces are not what they were.
bool GapSweep::renew_gap(std::uint32_t entry) {
  const Status& status = order_.status();
  order_.status()[entry].is_stale = false;
  const std::uint32_t above = status[entry].above;
  const std::uint32_t upper =
      above == status.sentinel() || status[entry].is_tied ? kNone : above;
  const Faces faces = visitor_->above(entry, gaps_[status[entry].below].faces);
  Gap& gap = gaps_[entry];
  const bool has_new_faces = faces != gap.faces;
  if (!has_new_faces && upper == gap.upper) return false;
  close(gap, order_.cluster().left);
  gap.lower = entry;
  gap.upper = upper;
  gap.faces = faces;
  if (upper != kNone) {
    const double x = order_.cluster().right;
    gap.begin = x;
    for (const std::uint32_t chain : {entry, upper}) {
      order_.status()[chain].cursor.advance(x);
    }
    gap.lower_at = status[entry].cursor;
    gap.upper_at = status[upper].cursor;
  }
  return has_new_faces;
}

void GapSweep::close(Gap& gap, double end) {
  if (gap.upper == kNone || !(end > gap.begin)) return;
  gap.end = end;
  visitor_->take(gap);
}

}  // namespace lamina::plane
