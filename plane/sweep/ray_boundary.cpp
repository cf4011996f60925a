#include "plane/sweep/ray_boundary.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace lamina::plane {

// --- A cluster --------------------------------------------------------------

void RayBoundary::begin_layer(ProgramStates& states) {
  states_ = &states;
  states.begin_layer();
  stitcher_.begin();
}

// Keeps the states of the entries on the ray, where thousands of leaves
// overlap.
void RayBoundary::forget_unused_states() {
  std::vector<ProgramStates::State*> live;
  for (std::uint32_t e = status_.first(); e != status_.sentinel();
       e = status_[e].above) {
    live.push_back(&status_[e].state);
  }
  states_->keep_only(live);
}

void RayBoundary::add_lone_loop(const Chain& lower, const Chain& upper,
                                std::span<const Vec2> points) {
  const std::span<const Vec2> lower_points = lower.points_in(points);
  const std::uint32_t below =
      status_.find_below(lower_points.front().y, cluster_.left);
  const ProgramStates::State around = status_[below].state;
  const ProgramStates::State within = states_->state_above(
      around, states_->crossing_of(lower.operand, lower.winding));
  const int side = static_cast<int>(states_->is_solid(within)) -
                   static_cast<int>(states_->is_solid(around));
  if (side == 0) return;
  stitcher_.add_loop(lower_points, upper.points_in(points),
                     static_cast<std::int8_t>(side));
}

void RayBoundary::end_side(std::uint32_t chain) {
  Entry& entry = status_[chain];
  end_arc(entry);
  note_disorder_before(entry.below, chain);
  note_disorder_before(chain, entry.above);
  entry.side = 0;
}

void RayBoundary::update(const EventCluster& cluster, OrderChanges& changes) {
  cluster_ = cluster;
  update_states(changes);
  update_sides(changes);
  split_at_touches(changes);
  stitcher_.link_ends();
  check_entries();
}

// --- States and sides -------------------------------------------------------

void RayBoundary::update_states(OrderChanges& changes) {
  // Bottom-up, so that no state is made from one that is about to change.
  if (changes.stale.size() > 2) {
    stale_by_y_.clear();
    for (const std::uint32_t entry : changes.stale) {
      if (!status_.is_alive(entry)) continue;
      stale_by_y_.push_back({status_.y_at(entry, cluster_.right), entry});
    }
    std::sort(stale_by_y_.begin(), stale_by_y_.end());
    changes.stale.clear();
    for (const auto& [y, entry] : stale_by_y_) changes.stale.push_back(entry);
  }
  for (const std::uint32_t entry : changes.stale) {
    if (status_.is_alive(entry) && status_[entry].is_stale) {
      update_states_from(entry, changes);
    }
  }
  // I1: nothing contains what is above all chains.
  const std::uint32_t last = status_[status_.sentinel()].below;
  if (status_[last].state != ProgramStates::kOutside) ++unbalanced_clusters_;
}

// I2: the state above an entry follows from the state below it and the entry's
// crossing. Restores that from `entry` up to where nothing changes any more, so
// that a vertical wall costs only the entries that it spans.
void RayBoundary::update_states_from(std::uint32_t entry,
                                     OrderChanges& changes) {
  Status& status = status_;
  while (status[status[entry].below].is_stale &&
         status[entry].below != status.sentinel()) {
    entry = status[entry].below;
  }
  ProgramStates::State state = status[status[entry].below].state;
  std::uint64_t steps = 0;
  for (; entry != status.sentinel(); entry = status[entry].above, ++steps) {
    Entry& e = status[entry];
    state = states_->state_above(state, e.crossing);
    if (!e.is_stale && e.state == state) break;
    e.is_stale = false;
    e.state = state;
    changes.unsure.push_back(entry);
  }
  status.note_walk(steps);
}

void RayBoundary::update_sides(const OrderChanges& changes) {
  Status& status = status_;
  for (const std::uint32_t entry : changes.unsure) {
    if (status.is_alive(entry) &&
        status[entry].side_cluster != cluster_.number) {
      update_group(entry);
    }
  }
}

// Tied entries are one curve: the solid below the lowest against that above
// the highest decides, and one member stands for all.
void RayBoundary::update_group(std::uint32_t member) {
  Status& status = status_;
  std::uint32_t first = member;
  while (status[status[first].below].is_tied) first = status[first].below;
  std::uint32_t last = member;
  while (status[last].is_tied) last = status[last].above;
  const bool below = states_->is_solid(status[status[first].below].state);
  const bool above = states_->is_solid(status[last].state);
  const auto side = static_cast<std::int8_t>(above - below);
  if (first == last) {
    status[first].side_cluster = cluster_.number;
    change_side(status[first], side);
    return;
  }

  // The member that represented it before goes on.
  std::uint32_t chosen = first;
  if (side != 0) {
    for (std::uint32_t e = first;; e = status[e].above) {
      if (status[e].side == side) {
        chosen = e;
        break;
      }
      if (e == last) break;
    }
  }
  std::uint64_t steps = 0;
  for (std::uint32_t e = first;; e = status[e].above, ++steps) {
    status[e].side_cluster = cluster_.number;
    change_side(status[e], e == chosen ? side : std::int8_t{0});
    if (e == last) break;
  }
  status.note_walk(steps);
}

void RayBoundary::change_side(Entry& entry, std::int8_t side) {
  if (entry.side == side) return;
  if (entry.side != 0) end_arc(entry);
  entry.side = side;
  if (side != 0) start_arc(entry);
}

// --- Touches ----------------------------------------------------------------

// Splits arcs that go on straight through the cluster: where they touch other
// boundary in a point, so that the stitcher sees the touch, and where they run
// along the cluster past ends.
void RayBoundary::split_at_touches(const OrderChanges& changes) {
  Status& status = status_;
  for (const std::uint32_t lower : changes.touches) {
    if (!status.is_alive(lower)) continue;
    const std::uint32_t upper = status[lower].above;
    if (upper == status.sentinel()) continue;
    note_disorder_after(lower, upper);
    const double y = y_after(status[lower]);
    if (std::abs(y_after(status[upper]) - y) < kClusterWidth) {
      split_all_near(lower, y);
    }
  }
  for (const std::uint32_t number : changes.unsure) {
    if (!status.is_alive(number)) continue;
    Entry& entry = status[number];
    if (entry.touch_cluster == cluster_.number) continue;
    entry.touch_cluster = cluster_.number;
    if (entry.side == 0 && !stitcher_.has_ends()) continue;
    const double y = y_after(entry);
    if (entry.side != 0) {
      note_disorder_after(entry.below, number);
      note_disorder_after(number, entry.above);
      if (std::abs(y_before(entry) - y) >= kClusterWidth) split_arc(entry);
    }
    // One split is enough for all that is in one point.
    if (entry.near_cluster == cluster_.number && entry.near_y == y) continue;
    if (stitcher_.has_end_near(y) || meets_boundary(number, y)) {
      split_all_near(number, y);
    }
  }
}

// Whether the entry is boundary and other boundary above it goes through the
// same point; entries that are not boundary may lie between. There is no need
// to look below: whatever happens in a point, the entries on both sides of it
// are listed.
bool RayBoundary::meets_boundary(std::uint32_t number, double y) {
  if (status_[number].side == 0) return false;
  for (std::uint32_t e = status_[number].above; e != status_.sentinel();
       e = status_[e].above) {
    if (std::abs(y_after(status_[e]) - y) >= kClusterWidth) return false;
    if (status_[e].side != 0) return true;
  }
  return false;
}

// Splits all arcs through a point of the cluster. `number` is an entry there;
// others may lie between it and the arcs. Many entries may ask for the same
// point, each with its own rounding: what the last one split is passed over.
void RayBoundary::split_all_near(std::uint32_t number, double y) {
  const bool goes_on = near_.cluster == cluster_.number &&
                       status_[number].near_cluster == cluster_.number &&
                       status_[number].near_y == near_.y;
  if (!goes_on) {
    near_ = {cluster_.number, y, status_[number].above, number};
  }
  const auto split = [&](std::uint32_t e) {
    if (e == status_.sentinel()) return false;
    Entry& entry = status_[e];
    if (std::abs(y_after(entry) - y) >= kClusterWidth) return false;
    entry.near_cluster = cluster_.number;
    entry.near_y = near_.y;
    if (entry.side != 0) split_arc(entry);
    return true;
  };
  while (split(status_[near_.first].below)) {
    near_.first = status_[near_.first].below;
  }
  while (split(status_[near_.last].above)) {
    near_.last = status_[near_.last].above;
  }
}

void RayBoundary::split_arc(Entry& entry) {
  if (entry.split_cluster == cluster_.number) return;
  end_arc(entry);
  start_arc(entry);
}

// Boundary may be out of order with the boundary next to it by less than a tie:
// on the left of the cluster, where a chain is about to end, or on its right.
void RayBoundary::note_disorder_before(std::uint32_t lower,
                                       std::uint32_t upper) {
  note_disorder(lower, upper, [this](const Entry& e) { return y_before(e); });
}

void RayBoundary::note_disorder_after(std::uint32_t lower,
                                      std::uint32_t upper) {
  note_disorder(lower, upper, [this](Entry& e) { return y_after(e); });
}

// Between neighbours on the boundary other entries may lie: the rest of two
// groups of ties, or what is inside the solid.
template <typename YOf>
void RayBoundary::note_disorder(std::uint32_t lower, std::uint32_t upper,
                                const YOf& y_of) {
  Status& status = status_;
  const std::uint32_t sentinel = status.sentinel();
  if (lower == sentinel || upper == sentinel) return;
  const double y = y_of(status[upper]);
  // Neighbours that far apart are in order, and so is what ties with them.
  if (y - y_of(status[lower]) > 2 * kMostJump * tie_distance_) return;
  const auto is_passed = [&](std::uint32_t e) {
    return e != sentinel && status[e].side == 0 &&
           std::abs(y_of(status[e]) - y) <= kMostJump * tie_distance_;
  };
  while (is_passed(lower)) lower = status[lower].below;
  while (is_passed(upper)) upper = status[upper].above;
  if (lower == sentinel || upper == sentinel) return;
  if (status[lower].side == 0 || status[upper].side == 0) return;
  if (y_of(status[upper]) - y_of(status[lower]) > -kClusterWidth) return;
  std::uint32_t e = lower;
  while (e != upper && status[e].is_tied) e = status[e].above;
  if (e != upper) stitcher_.note_jump();
}

// --- Arcs -------------------------------------------------------------------

ChainCursor RayBoundary::cursor_before(const Entry& entry) const {
  const Vec2* left = entry.cursor.left();
  const Vec2* last = entry.cursor.last();
  while (left != entry.first && left->x >= cluster_.left) --left;
  while (left + 1 != last && left[1].x < cluster_.left) ++left;
  return {left, last};
}

// The segment on which an arc ends or starts at y: this one, if it holds y.
// Where a steep chain crosses at the x of one of its vertices, the crossing may
// be far from the vertex, on the segment beyond.
ChainCursor RayBoundary::cursor_of_end(const Entry& entry,
                                       const ChainCursor& cursor,
                                       double y) const {
  const auto holds_y = [y](const ChainCursor& segment) {
    const auto [low, high] =
        std::minmax(segment.left()[0].y, segment.left()[1].y);
    return low <= y && y <= high;
  };
  if (!crosses_here(entry) || holds_y(cursor)) return cursor;
  for (const ChainCursor& other : {cursor_before(entry), entry.cursor}) {
    if (holds_y(other)) return other;
  }
  return cursor;
}

// I5: where a chain begins or ends in the cluster, its endpoint is the point,
// exactly. Only a chain that runs along the cluster is taken where the order on
// that side holds, so that the region stays the union of trapezoids between
// clusters (I4).
void RayBoundary::end_arc(Entry& entry) {
  const double y = y_before(entry);
  const ChainCursor cursor = cursor_of_end(entry, cursor_before(entry), y);
  const Vec2& last = *cursor.last();
  Vec2 point(cluster_.left, y);
  if (cluster_.holds(last.x) && std::abs(last.y - y) < kClusterWidth)
    point = last;
  if (crosses_here(entry)) note_moved_end(cursor, point);
  stitcher_.end_arc(entry.arc, point, y, cursor.left());
  entry.split_cluster = cluster_.number;
}

void RayBoundary::start_arc(Entry& entry) {
  const double y = y_after(entry);
  const Vec2& first = *entry.first;
  Vec2 point(cluster_.right, y);
  if (cluster_.holds(first.x) && std::abs(first.y - y) < kClusterWidth) {
    point = first;
  }
  const ChainCursor cursor = cursor_of_end(entry, entry.cursor, y);
  if (crosses_here(entry)) note_moved_end(cursor, point);
  entry.arc = stitcher_.start_arc(point, y, cursor.left(), entry.side);
  entry.split_cluster = cluster_.number;
}

// The point of a crossing may be off a steep chain by what the cluster's width,
// or the rounding of x, makes of it. More was a tie at the end of a segment.
void RayBoundary::note_moved_end(const ChainCursor& cursor, const Vec2& point) {
  const double distance = std::abs(cursor.y_at(point.x) - point.y);
  const double width =
      std::max(kClusterWidth,
               std::abs(point.x) * std::numeric_limits<double>::epsilon());
  const double reach = 2 * width * (1 + std::abs(cursor.slope()));
  // I5; several ties may be at work in one cluster: six were met, where edges
  // are hardly longer than a tie.
  assert(distance <= 16 * tie_distance_ + reach);
  if (distance > reach) stitcher_.note_jump();
}

// --- Invariants -------------------------------------------------------------

// I1 and I2: from the bottom up, the crossings lead to the states and back to
// kOutside. I3: neighbours are apart or tied, as far as the rounding of steep
// chains lets their y show it. Debug builds only; long rays at some clusters.
void RayBoundary::check_entries() {
#ifndef NDEBUG
  constexpr std::size_t kLongRay = 100;
  if (status_.sentinel() > kLongRay && cluster_.number % kLongRay != 0) return;
  ProgramStates::State state = ProgramStates::kOutside;
  for (std::uint32_t e = status_.first(); e != status_.sentinel();
       e = status_[e].above) {
    Entry& lower = status_[e];
    state = states_->state_above(state, lower.crossing);
    assert(!lower.is_stale);
    assert(lower.state == state);
    if (lower.above == status_.sentinel()) break;
    Entry& upper = status_[lower.above];
    const double distance = y_after(upper) - y_after(lower);
    const double slope = std::max(std::abs(lower.cursor.slope()),
                                  std::abs(upper.cursor.slope()));
    const double rounding = 1e-12 * slope + 1e-9;
    assert(distance >= -2 * tie_distance_ - rounding);
    assert(!lower.is_tied || distance <= 2 * tie_distance_ + rounding);
  }
  assert(state == ProgramStates::kOutside);
#endif
}

}  // namespace lamina::plane
