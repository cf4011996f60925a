#include "plane/order/ray_order.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace lamina::plane {
namespace {

// Swaps in one cluster, for each chain of the layer, before they count as
// endless: rounding could make the pairwise order of entries a circle.
constexpr std::uint64_t kMostSwapsPerEntry = 64;

// A slab for so many points, within limits. From 48 to 512 points make no more
// than 10 %.
constexpr double kPointsPerSlab = 128;
constexpr double kLeastSlabs = 4;
constexpr double kMostSlabs = 4096;

}  // namespace

std::uint32_t slab_count_of(std::size_t point_count) {
  return static_cast<std::uint32_t>(
      std::ceil(std::clamp(static_cast<double>(point_count) / kPointsPerSlab,
                           kLeastSlabs, kMostSlabs)));
}

void RayOrder::begin_layer(std::size_t chain_count, double low, double high,
                           std::uint32_t slab_count) {
  status_.begin(chain_count);
  queue_.begin(low, high, slab_count);
  cluster_ = {};
  swaps_ = 0;
  to_check_.clear();
}

// Entering a slab may find failures; a cluster that reaches into it is handled
// behind that.
double RayOrder::next_event_point(double next_endpoint) {
  for (;;) {
    const double x = std::min(next_endpoint, queue_.next_failure());
    if (queue_.slab_end() > x + kClusterWidth) return x;
    queue_.enter_next_slab();
    renew_certificates(x);
  }
}

// Renews the certificates that end in the slab just entered, perhaps just
// behind the next event point.
void RayOrder::renew_certificates(double next_event_point) {
  // The cluster before may reach into this slab.
  const double x =
      std::max(std::min(queue_.slab_start(), next_event_point), cluster_.right);
  queue_.visit_renewals([this, x](const PairRef& pair) {
    const std::uint32_t lower = pair.entry;
    if (!status_.is_alive(lower)) return;
    if (status_[lower].stamp != pair.stamp) return;
    const Certificate certificate =
        certify_pair(lower, status_[lower].above, x);
    assert(certificate.relation == (status_[lower].is_tied ? 0 : 1));
    schedule(lower, certificate);
  });
}

// --- Chains -----------------------------------------------------------------

void RayOrder::remove(std::uint32_t chain) {
  const std::uint32_t below = status_[chain].below;
  const std::uint32_t above = status_[chain].above;
  status_.remove(chain);
  separate(below);
  changes_.unsure.push_back(below);
  changes_.unsure.push_back(above);
  status_[above].is_stale = true;
  changes_.stale.push_back(above);
}

void RayOrder::insert(std::uint32_t chain, std::span<const Vec2> points,
                      ProgramStates::Crossing crossing) {
  Entry entry;
  entry.cursor = ChainCursor(&points.front(), &points.back());
  entry.first = &points.front();
  entry.crossing = crossing;
  entry.is_stale = true;
  entry.cursor.advance(cluster_.right);
  const std::uint32_t below = find_place(points.front(), entry.cursor);
  status_[chain] = entry;
  status_.insert_above(below, chain);
  separate(below);
  to_check_.push_back(chain);
  changes_.stale.push_back(chain);
  changes_.unsure.push_back(below);
  changes_.unsure.push_back(status_[chain].above);
}

// The entry above which a new chain belongs.
std::uint32_t RayOrder::find_place(const Vec2& point,
                                   const ChainCursor& cursor) {
  const double y = cursor.y_at(cluster_.right);
  const std::uint32_t sentinel = status_.sentinel();
  std::uint32_t below = status_.find_below(point.y, cluster_.right);
  std::uint64_t steps = 0;
  for (; below != sentinel && is_above(below, y, cursor); ++steps) {
    below = status_[below].below;
  }
  for (;; ++steps) {
    const std::uint32_t above = status_[below].above;
    if (above == sentinel || is_above(above, y, cursor)) break;
    below = above;
  }
  status_.note_walk(steps);
  return below;
}

// Whether the entry lies above a chain that starts with `cursor` at y; where y
// ties, by how they go on.
bool RayOrder::is_above(std::uint32_t number, double y,
                        const ChainCursor& cursor) {
  Entry& entry = status_[number];
  entry.cursor.advance(cluster_.right);
  const double distance = entry.cursor.y_at(cluster_.right) - y;
  if (std::abs(distance) > tie_distance_) return distance > 0;
  const Certificate certificate = certify(cursor, entry.cursor, cluster_.right,
                                          cluster_.right, tie_distance_);
  return certificate.relation > 0 ||
         (certificate.relation == 0 && distance > 0);
}

// --- Pairs ------------------------------------------------------------------

// Takes the failures inside the cluster; false where there are none.
bool RayOrder::take_failures() {
  bool is_any = false;
  while (queue_.next_failure() <= cluster_.end()) {
    const double x = queue_.next_failure();
    const PairRef pair = queue_.take_failure();
    if (!status_.is_alive(pair.entry)) continue;
    if (status_[pair.entry].stamp != pair.stamp) continue;
    cluster_.right = std::max(cluster_.right, x);
    ++status_[pair.entry].stamp;
    to_check_.push_back(pair.entry);
    changes_.touches.push_back(pair.entry);
    is_any = true;
  }
  return is_any;
}

// Puts new neighbours in the order that holds right of the cluster.
void RayOrder::settle_pairs() {
  while (!to_check_.empty()) {
    const std::uint32_t lower = to_check_.back();
    to_check_.pop_back();
    const std::uint32_t sentinel = status_.sentinel();
    if (!status_.is_alive(lower)) continue;
    if (status_[lower].settled == status_[lower].stamp) continue;
    const std::uint32_t upper = status_[lower].above;
    if (upper == sentinel) {
      set_tie(lower, false);
      continue;
    }
    Certificate certificate = certify_pair(lower, upper, cluster_.right);
    if (certificate.relation < 0) {
      const std::uint64_t most = kMostSwapsPerEntry * sentinel;
      const std::uint64_t swaps = ++swaps_ - swaps_before_;
      if (swaps <= most) {
        swap_with_above(lower);
        continue;
      }
      if (swaps == most + 1) ++capped_clusters_;
      certificate = {};
    }
    set_tie(lower, certificate.relation == 0);
    schedule(lower, certificate);
    status_[lower].settled = status_[lower].stamp;
  }
}

void RayOrder::swap_with_above(std::uint32_t lower) {
  const std::uint32_t upper = status_[lower].above;
  const std::uint32_t below = status_[lower].below;
  changes_.unsure.push_back(below);
  changes_.unsure.push_back(status_[upper].above);
  note_crossing(status_[lower], status_[upper]);
  status_.swap_with_above(lower);
  for (const std::uint32_t entry : {below, upper, lower}) separate(entry);
  for (const std::uint32_t entry : {lower, upper}) {
    status_[entry].is_stale = true;
    changes_.stale.push_back(entry);
    changes_.unsure.push_back(entry);
  }
}

// Where two chains cross they have one point, on the flatter one: a steep one's
// y at the rounded x may be far off. Where they have passed each other by that
// x, and one of them has a vertex there, it is its segment before that crosses.
void RayOrder::note_crossing(Entry& lower, Entry& upper) {
  const double x = cluster_.right;
  const bool has_passed = upper.cursor.y_at(x) < lower.cursor.y_at(x);
  const auto steepness = [&](const Entry& entry) {
    const Vec2* left = entry.cursor.left();
    const bool is_before = has_passed && left->x == x && left != entry.first;
    return std::abs(is_before ? ChainCursor(left - 1, left).slope()
                              : entry.cursor.slope());
  };
  const bool is_lower_steeper = steepness(lower) > steepness(upper);
  Entry& steeper = is_lower_steeper ? lower : upper;
  const Entry& flatter = is_lower_steeper ? upper : lower;
  steeper.crossing_y = flatter.cursor.y_at(x);
  steeper.crossing_cluster = cluster_.number;
}

void RayOrder::set_tie(std::uint32_t entry, bool is_tied) {
  if (status_[entry].is_tied == is_tied) return;
  status_[entry].is_tied = is_tied;
  changes_.unsure.push_back(entry);
  changes_.unsure.push_back(status_[entry].above);
}

// --- Certificates -----------------------------------------------------------

// Certifies a pair from x to the end of the slab, in the last one to the end
// of a chain, but past the cluster of x in any case, so that nothing in the
// cluster is missed. Where the bands of the chains are apart there is no need
// to look at their points.
Certificate RayOrder::certify_pair(std::uint32_t lower, std::uint32_t upper,
                                   double x) {
  Entry& a = status_[lower];
  Entry& b = status_[upper];
  a.cursor.advance(x);
  b.cursor.advance(x);
  const double limit = std::max(queue_.slab_end(), x + kClusterWidth);
  for (Entry* entry : {&a, &b}) {
    if (entry->band_slab != queue_.slab()) find_band(*entry, limit);
  }
  // From where the present segments are both there.
  const double left = std::max(a.cursor.left_x(), b.cursor.left_x());
  const XRange apart = range_apart(a.band, b.band, left, tie_distance_);
  if (apart.end <= std::max(x + kClusterWidth, apart.begin)) {
    return certify(a.cursor, b.cursor, x, limit, tie_distance_);
  }
  return certify_outside(a, b, apart, x, limit);
}

// Certifies a pair from x on where its bands are not apart: before that range,
// or behind it, hence at one of the two.
Certificate RayOrder::certify_outside(const Entry& a, const Entry& b,
                                      const XRange& apart, double x,
                                      double limit) {
  const Band& shorter = a.band.right <= b.band.right ? a.band : b.band;
  if (apart.end < shorter.right) {
    ChainCursor lower = a.cursor;
    ChainCursor upper = b.cursor;
    lower.advance(apart.end);
    upper.advance(apart.end);
    return certify(lower, upper, apart.end, limit, tie_distance_);
  }
  Certificate certificate;
  certificate.valid_until = x;
  if (apart.begin > x) {
    certificate = certify(a.cursor, b.cursor, x, std::min(limit, apart.begin),
                          tie_distance_);
  }
  if (certificate.relation > 0 && certificate.failure == kNever &&
      certificate.valid_until < shorter.right) {
    certificate.valid_until = shorter.right;
  }
  if (certificate.valid_until == shorter.right && shorter.ends_chain) {
    certificate.valid_until = kNever;
  }
  return certificate;
}

void RayOrder::find_band(Entry& entry, double limit) {
  entry.band_slab = queue_.slab();
  const ChainCursor& cursor = entry.cursor;
  entry.band = Band(cursor.left(), cursor.slope(), cursor.last(), limit);
}

void RayOrder::schedule(std::uint32_t lower, const Certificate& certificate) {
  assert(certificate.failure > cluster_.right);  // I6
  queue_.schedule({lower, ++status_[lower].stamp}, certificate);
}

}  // namespace lamina::plane
