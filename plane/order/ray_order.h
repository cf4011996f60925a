#pragma once
// The order of the moving ray: status, event queue and certificates.
//
// At an event point chains end and begin, and certificates fail. Each makes
// new neighbours, and these are certified from the right side of the event
// point on; out of order they are swapped, which makes new neighbours again.
// So between event points neighbours are apart or tied (I3).
//
// Rounding spreads what belongs to one x. So all that lies within
// kClusterWidth of an event point is one **event cluster** and happens at once:
// a chain that begins and the crossing that it causes 1e-16 later, taken one
// after the other, would leave a wall of no thickness. What the order does in a
// cluster, the boundary learns afterwards from OrderChanges.

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "plane/chains.h"
#include "plane/order/band.h"
#include "plane/order/certificate.h"
#include "plane/order/event_queue.h"
#include "plane/order/status.h"

namespace lamina::plane {

struct EventCluster {
  std::uint32_t number = 0;  // in the layer, from 1
  // The order before the cluster holds up to `left`, the order after it from
  // `right` on; of one event the two are the same.
  double left = 0;
  double right = -kNever;

  // What lies no further right belongs to it.
  double end() const { return left + kClusterWidth; }
  bool holds(double x) const { return x >= left && x <= end(); }
};

// What a cluster changed, by entries. An entry may be listed twice, or have
// left the ray since.
struct OrderChanges {
  std::vector<std::uint32_t> stale;    // the state above is in doubt
  std::vector<std::uint32_t> unsure;   // the side is in doubt
  std::vector<std::uint32_t> touches;  // may touch the entry above in a point
};

// How many slabs a layer with so many points on its chains had better have.
std::uint32_t slab_count_of(std::size_t point_count);

class RayOrder {
 public:
  explicit RayOrder(double tie_distance) : tie_distance_(tie_distance) {}

  // Empties the ray for a layer; its slabs divide [low, high].
  void begin_layer(std::size_t chain_count, double low, double high,
                   std::uint32_t slab_count);

  Status& status() { return status_; }
  const Status& status() const { return status_; }
  const EventCluster& cluster() const { return cluster_; }
  // Changes in the present cluster; their reader may use them up.
  OrderChanges& changes() { return changes_; }

  // x of the next event point: the next endpoint, or a failure before it.
  // Renews certificates on the way.
  double next_event_point(double next_endpoint);

  // A cluster begins at event point x, takes the endpoints inside it from left
  // to right, and ends with settle(). At an endpoint a chain leaves the ray, or
  // enters it; all endpoints are taken before the first chain enters.
  void begin_cluster(double x) {
    assert(x > cluster_.right);  // I6
    cluster_ = {cluster_.number + 1, x, x};
    swaps_before_ = swaps_;
    changes_.stale.clear();
    changes_.unsure.clear();
    changes_.touches.clear();
  }
  void take_endpoint(double x) { cluster_.right = x; }
  void remove(std::uint32_t chain);
  void insert(std::uint32_t chain, std::span<const Vec2> points,
              ProgramStates::Crossing crossing);
  // Restores the order right of the cluster, which may bring up failures
  // inside it: again until there are none.
  void settle() {
    do {
      settle_pairs();
    } while (take_failures());
  }

  // Swaps of neighbours in the layer so far.
  std::uint64_t swaps() const { return swaps_; }
  // Clusters in which swaps reached their cap, since construction: always 0.
  std::uint64_t capped_clusters() const { return capped_clusters_; }

 private:
  void renew_certificates(double next_event_point);
  std::uint32_t find_place(const Vec2& point, const ChainCursor& cursor);
  bool is_above(std::uint32_t entry, double y, const ChainCursor& cursor);
  bool take_failures();
  void settle_pairs();
  void swap_with_above(std::uint32_t lower);
  void note_crossing(Entry& lower, Entry& upper);
  void set_tie(std::uint32_t entry, bool is_tied);
  Certificate certify_pair(std::uint32_t lower, std::uint32_t upper, double x);
  Certificate certify_outside(const Entry& a, const Entry& b,
                              const XRange& apart, double x, double limit);
  void find_band(Entry& entry, double limit);
  void schedule(std::uint32_t lower, const Certificate& certificate);
  // The pair above the entry is another one from here on.
  void separate(std::uint32_t entry) {
    status_[entry].is_tied = false;
    ++status_[entry].stamp;
    to_check_.push_back(entry);
  }

  const double tie_distance_;
  Status status_;
  EventQueue queue_;
  EventCluster cluster_;
  OrderChanges changes_;
  std::vector<std::uint32_t> to_check_;  // lower entries of new pairs
  std::uint64_t swaps_ = 0;              // in the layer
  std::uint64_t swaps_before_ = 0;       // the cluster
  std::uint64_t capped_clusters_ = 0;
};

}  // namespace lamina::plane
