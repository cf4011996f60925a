#pragma once
// The boundary of the solid along the moving ray: states of the program,
// boundary sides and arcs.
//
// The order (ray_order.h) reports which entries an event cluster touched. From
// there states are updated upwards until they are what they were; entries whose
// state differs in value from the one below are boundary, and where that
// changes, an arc ends or begins. The stitcher links what ended and began.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/vec.h"
#include "plane/chains.h"
#include "plane/contours.h"
#include "plane/order/ray_order.h"
#include "plane/order/status.h"
#include "plane/program/program_states.h"
#include "plane/sweep/stitcher.h"
#include "plane/sweep/sweep_options.h"

namespace lamina::plane {

class RayBoundary {
 public:
  // `status` must outlive the object.
  RayBoundary(Status& status, const SweepOptions& options)
      : status_(status),
        tie_distance_(options.tie_distance),
        stitcher_(options) {}

  // Forgets the layer before. `states` must outlive the new one.
  void begin_layer(ProgramStates& states);

  // In this order, for each event cluster:
  void begin_cluster(const EventCluster& cluster) {
    if (states_->is_full()) forget_unused_states();
    cluster_ = cluster;
  }
  // A lone loop begins in the cluster; its two chains. It is boundary as a
  // whole or not at all.
  void add_lone_loop(const Chain& lower, const Chain& upper,
                     std::span<const Vec2> points);
  // The order is about to remove the chain: its arc ends.
  void end_chain(std::uint32_t chain) {
    if (status_[chain].side != 0) end_side(chain);
  }
  // The order is settled: brings states, sides and arcs up to date. Uses the
  // changes up.
  void update(const EventCluster& cluster, OrderChanges& changes);

  // Replaces `contours` by the loops of the layer.
  void write_loops(Contours& contours) { stitcher_.write_loops(contours); }

  // Whether boundary of the layer may run into other boundary, by less than a
  // tie: it changed over between tied chains that are not the same up to
  // rounding, or passed a chain that ties.
  bool has_jumps() const { return stitcher_.has_jumps(); }

  // Since construction, always 0: clusters after which a state other than
  // kOutside was above all entries, and ends of arcs without a partner.
  std::uint64_t unbalanced_clusters() const { return unbalanced_clusters_; }
  std::uint64_t unlinked_ends() const { return stitcher_.unlinked_ends(); }

 private:
  void forget_unused_states();
  void update_states(OrderChanges& changes);
  void update_states_from(std::uint32_t entry, OrderChanges& changes);
  void update_sides(const OrderChanges& changes);
  void update_group(std::uint32_t member);
  void end_side(std::uint32_t chain);
  void change_side(Entry& entry, std::int8_t side);
  void split_at_touches(const OrderChanges& changes);
  bool meets_boundary(std::uint32_t number, double y);
  void split_all_near(std::uint32_t number, double y);
  void split_arc(Entry& entry);
  void note_disorder_before(std::uint32_t lower, std::uint32_t upper);
  void note_disorder_after(std::uint32_t lower, std::uint32_t upper);
  template <typename YOf>
  void note_disorder(std::uint32_t lower, std::uint32_t upper, const YOf& y_of);
  void end_arc(Entry& entry);
  void start_arc(Entry& entry);
  void note_moved_end(const ChainCursor& cursor, const Vec2& point);
  void check_entries();

  // The entry's segment and y where it meets the cluster from the left, and y
  // where it leaves it to the right.
  ChainCursor cursor_before(const Entry& entry) const;
  ChainCursor cursor_of_end(const Entry& entry, const ChainCursor& cursor,
                            double y) const;
  double y_before(const Entry& entry) const {
    if (crosses_here(entry)) return entry.crossing_y;
    const ChainCursor& cursor = entry.cursor;
    if (cursor.left_x() < cluster_.left && cursor.right_x() >= cluster_.left) {
      return cursor.y_at(cluster_.left);
    }
    return cursor_before(entry).y_at(cluster_.left);
  }
  double y_after(Entry& entry) const {
    entry.cursor.advance(cluster_.right);
    return crosses_here(entry) ? entry.crossing_y
                               : entry.cursor.y_at(cluster_.right);
  }
  bool crosses_here(const Entry& entry) const {
    return entry.crossing_cluster == cluster_.number &&
           cluster_.left == cluster_.right;
  }

  Status& status_;
  ProgramStates* states_ = nullptr;
  const double tie_distance_;
  Stitcher stitcher_;
  EventCluster cluster_;
  // The entries that split_all_near() has split around a point.
  struct {
    std::uint32_t cluster = 0;  // 0: none yet
    double y = 0;
    std::uint32_t first = 0;
    std::uint32_t last = 0;
  } near_;
  std::vector<std::pair<double, std::uint32_t>> stale_by_y_;
  std::uint64_t unbalanced_clusters_ = 0;
};

}  // namespace lamina::plane
