// The boundary in a column: sets of leaves, survival, pieces (ray_sweep.h).

#include <algorithm>
#include <cassert>
#include <cmath>

#include "ldni/sweep/detail/ray_sweep.h"

namespace lamina::ldni::detail {

// --- Sets and survival ------------------------------------------------------

void RaySweep::update_sets() {
  // Bottom-up, so that no set is made from one that is about to change.
  if (fresh_.size() > 2) {
    fresh_by_y_.clear();
    for (const std::uint32_t entry : fresh_) {
      if (!status_.is_alive(entry)) continue;
      fresh_by_y_.push_back({status_.y_at(entry, column_right_), entry});
    }
    std::sort(fresh_by_y_.begin(), fresh_by_y_.end());
    fresh_.clear();
    for (const auto& [y, entry] : fresh_by_y_) fresh_.push_back(entry);
  }
  for (const std::uint32_t entry : fresh_) {
    if (status_.is_alive(entry) && status_[entry].is_fresh) {
      update_sets_from(entry);
    }
  }
  // I1: no leaf contains what is above all chains.
  const std::uint32_t last = status_[status_.sentinel()].below;
  if (status_[last].set != LeafSets::kEmpty) ++counts_.unbalanced_columns;
}

// I2: the set above an entry is the set below it after the entry's step.
// Restores that from `entry` up to where nothing changes any more, so that a
// vertical wall costs only the entries that it spans.
void RaySweep::update_sets_from(std::uint32_t entry) {
  while (status_[status_[entry].below].is_fresh &&
         status_[entry].below != status_.sentinel()) {
    entry = status_[entry].below;
  }
  LeafSets::Id set = status_[status_[entry].below].set;
  for (; entry != status_.sentinel(); entry = status_[entry].above) {
    Entry& e = status_[entry];
    set = sets_.after(set, e.step);
    if (!e.is_fresh && e.set == set) return;
    e.is_fresh = false;
    e.set = set;
    touched_.push_back(entry);
  }
}

void RaySweep::update_survival() {
  for (const std::uint32_t entry : touched_) {
    if (status_.is_alive(entry) && status_[entry].column != column_) {
      update_group(entry);
    }
  }
}

// Tied entries are one curve: the solid below the lowest against that above
// the highest decides, and one member stands for all.
void RaySweep::update_group(std::uint32_t member) {
  std::uint32_t first = member;
  while (status_[status_[first].below].is_tied) first = status_[first].below;
  std::uint32_t last = member;
  while (status_[last].is_tied) last = status_[last].above;
  const bool below = sets_.value(status_[status_[first].below].set);
  const bool above = sets_.value(status_[last].set);
  const auto survival = static_cast<std::int8_t>(above - below);
  if (first == last) {
    status_[first].column = column_;
    change_survival(status_[first], survival);
    return;
  }

  // Whoever stood for it before goes on.
  std::uint32_t chosen = first;
  if (survival != 0) {
    for (std::uint32_t e = first;; e = status_[e].above) {
      if (status_[e].survival == survival) {
        chosen = e;
        break;
      }
      if (e == last) break;
    }
  }
  for (std::uint32_t e = first;; e = status_[e].above) {
    status_[e].column = column_;
    change_survival(status_[e], e == chosen ? survival : std::int8_t{0});
    if (e == last) break;
  }
}

void RaySweep::change_survival(Entry& entry, std::int8_t survival) {
  if (entry.survival == survival) return;
  if (entry.survival != 0) end_piece(entry);
  entry.survival = survival;
  if (survival != 0) start_piece(entry);
}

// --- Touches ----------------------------------------------------------------

// Cuts boundary that goes on straight through the column where it touches
// other boundary in a point, so that the tracer sees the touch, and where it
// runs along the column past ends.
void RaySweep::split_at_touches() {
  for (const std::uint32_t lower : touches_) {
    if (!status_.is_alive(lower)) continue;
    const std::uint32_t upper = status_[lower].above;
    if (upper == status_.sentinel()) continue;
    note_disorder_after(lower, upper);
    const double y = y_after(status_[lower]);
    if (std::abs(y_after(status_[upper]) - y) < kColumnWidth) {
      split_all_near(lower, y);
    }
  }
  for (const std::uint32_t number : touched_) {
    if (!status_.is_alive(number)) continue;
    Entry& entry = status_[number];
    if (entry.touch_column == column_) continue;
    entry.touch_column = column_;
    if (entry.survival == 0 && !tracer_.has_ends()) continue;
    const double y = y_after(entry);
    if (entry.survival != 0) {
      note_disorder_after(entry.below, number);
      note_disorder_after(number, entry.above);
      if (std::abs(y_before(entry) - y) >= kColumnWidth) split_piece(entry);
    }
    // One cut is enough for all that is in one point.
    if (entry.near_column == column_ && entry.near_y == y) continue;
    if (tracer_.has_end_near(y) || meets_boundary(number, y)) {
      split_all_near(number, y);
    }
  }
}

// Whether the entry is boundary and other boundary above it goes through the
// same point of the column; entries that are none may lie between. What is
// below has been touched as well: whatever happens in a point, the entries on
// both sides of it are.
bool RaySweep::meets_boundary(std::uint32_t number, double y) {
  if (status_[number].survival == 0) return false;
  for (std::uint32_t e = status_[number].above; e != status_.sentinel();
       e = status_[e].above) {
    if (std::abs(y_after(status_[e]) - y) >= kColumnWidth) return false;
    if (status_[e].survival != 0) return true;
  }
  return false;
}

// Cuts all boundary through a point of the column. `number` is an entry there;
// others may lie between it and the boundary.
void RaySweep::split_all_near(std::uint32_t number, double y) {
  const auto split = [&](std::uint32_t e) {
    Entry& entry = status_[e];
    if (std::abs(y_after(entry) - y) >= kColumnWidth) return false;
    entry.near_column = column_;
    entry.near_y = y;
    if (entry.survival != 0) split_piece(entry);
    return true;
  };
  const std::uint32_t sentinel = status_.sentinel();
  std::uint32_t e = number;
  while (e != sentinel && split(e)) e = status_[e].below;
  e = status_[number].above;
  while (e != sentinel && split(e)) e = status_[e].above;
}

void RaySweep::split_piece(Entry& entry) {
  if (entry.split_column == column_) return;
  end_piece(entry);
  start_piece(entry);
}

// Boundary may be out of order with the boundary next to it by less than a tie:
// on the left of the column, where a chain is about to end, or on its right.
void RaySweep::note_disorder_before(std::uint32_t lower, std::uint32_t upper) {
  note_disorder(lower, upper, [this](const Entry& e) { return y_before(e); });
}

void RaySweep::note_disorder_after(std::uint32_t lower, std::uint32_t upper) {
  note_disorder(lower, upper, [this](Entry& e) { return y_after(e); });
}

// Between neighbours on the boundary there may be entries that are none: the
// rest of two groups of ties, or what lies inside of the solid.
template <typename YOf>
void RaySweep::note_disorder(std::uint32_t lower, std::uint32_t upper,
                             const YOf& y_of) {
  const std::uint32_t sentinel = status_.sentinel();
  if (lower == sentinel || upper == sentinel) return;
  const double y = y_of(status_[upper]);
  // Neighbours that far apart are in order, and so is what ties with them.
  if (y - y_of(status_[lower]) > 2 * kMostJump * tie_distance_) return;
  const auto is_passed = [&](std::uint32_t e) {
    return e != sentinel && status_[e].survival == 0 &&
           std::abs(y_of(status_[e]) - y) <= kMostJump * tie_distance_;
  };
  while (is_passed(lower)) lower = status_[lower].below;
  while (is_passed(upper)) upper = status_[upper].above;
  if (lower == sentinel || upper == sentinel) return;
  if (status_[lower].survival == 0 || status_[upper].survival == 0) return;
  if (y_of(status_[upper]) - y_of(status_[lower]) > -kColumnWidth) return;
  std::uint32_t e = lower;
  while (e != upper && status_[e].is_tied) e = status_[e].above;
  if (e != upper) tracer_.note_jump();
}

// --- Pieces -----------------------------------------------------------------

// The entry's cursor where it meets the column from the left.
ChainCursor RaySweep::cursor_before(const Entry& entry) const {
  const Vec2* left = entry.cursor.left();
  const Vec2* last = entry.cursor.last();
  while (left != entry.first && left->x >= column_left_) --left;
  while (left + 1 != last && left[1].x < column_left_) ++left;
  return {left, last};
}

// I5: where a chain starts or ends in the column, its turn is the point,
// exactly. Only a chain that runs along the column is taken where the order of
// its side holds, so that the region stays the union of trapezoids between
// columns (I4).
void RaySweep::end_piece(Entry& entry) {
  const double y = y_before(entry);
  const ChainCursor cursor = cursor_before(entry);
  const Vec2& last = *cursor.last();
  Vec2 point(column_left_, y);
  if (is_in_column(last.x) && std::abs(last.y - y) < kColumnWidth) point = last;
  if (crosses_here(entry)) note_moved_end(cursor, point);
  tracer_.end_piece(entry.piece, point, y, cursor.left());
  entry.split_column = column_;
}

void RaySweep::start_piece(Entry& entry) {
  const double y = y_after(entry);
  const Vec2& first = *entry.first;
  Vec2 point(column_right_, y);
  if (is_in_column(first.x) && std::abs(first.y - y) < kColumnWidth) {
    point = first;
  }
  if (crosses_here(entry)) note_moved_end(entry.cursor, point);
  entry.piece =
      tracer_.start_piece(point, y, entry.cursor.left(), entry.survival);
  entry.split_column = column_;
}

// The point of a crossing may be off a steep chain by what the column's width
// makes of it. More was a tie at the end of a segment.
void RaySweep::note_moved_end(const ChainCursor& cursor, const Vec2& point) {
  const double distance = std::abs(cursor.y_at(point.x) - point.y);
  const double reach = 2 * kColumnWidth * (1 + std::abs(cursor.slope()));
  // I5; several ties may be at work in one column.
  assert(distance <= 4 * tie_distance_ + reach);
  if (distance > reach) tracer_.note_jump();
}

// --- Invariants -------------------------------------------------------------

// I1 and I2: from the bottom up, the steps lead to the sets and back to the
// empty one. I3: neighbours are apart or tied, as far as the rounding of steep
// chains lets their y tell. Debug builds only; long rays at some columns.
void RaySweep::check_entries() {
#ifndef NDEBUG
  constexpr std::size_t kLongRay = 100;
  if (chains_.size() > kLongRay && column_ % kLongRay != 0) return;
  LeafSets::Id set = LeafSets::kEmpty;
  for (std::uint32_t e = status_.first(); e != status_.sentinel();
       e = status_[e].above) {
    Entry& lower = status_[e];
    set = sets_.after(set, lower.step);
    assert(!lower.is_fresh);
    assert(lower.set == set);
    if (lower.above == status_.sentinel()) break;
    Entry& upper = status_[lower.above];
    const double distance = y_after(upper) - y_after(lower);
    const double slope = std::max(std::abs(lower.cursor.slope()),
                                  std::abs(upper.cursor.slope()));
    const double rounding = 1e-12 * slope + 1e-9;
    assert(distance >= -2 * tie_distance_ - rounding);
    assert(!lower.is_tied || distance <= 2 * tie_distance_ + rounding);
  }
  assert(set == LeafSets::kEmpty);
#endif
}

}  // namespace lamina::ldni::detail
