#include "ldni/sweep/detail/ray_sweep.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace lamina::ldni::detail {
namespace {

// Slabs of a layer where the pitch is left to us: one for so many points of
// its chains, within limits. From 48 to 512 points make no more than 10 %.
constexpr double kPointsPerSlab = 128;
constexpr double kLeastSlabs = 4;
constexpr double kMostSlabs = 4096;
constexpr double kMostSlabsOfPitch = 1 << 16;

// Known sets are forgotten between two layers when they are many: more than
// this, and more than so many times those of the first layer since, so that
// the tables stay in the cache and still serve several layers.
constexpr std::size_t kFewSets = 4096;
constexpr std::size_t kLayersOfSets = 4;

// Within a layer, sets that no entry has any more are forgotten when all cost
// more than this (8 bytes each), or so many times what is left.
constexpr std::size_t kMostCost = std::size_t{1} << 21;
constexpr std::size_t kGrowthOfCost = 3;

// Swaps in one column, for each chain of the layer, before it counts as
// endless: rounding could make the pairwise order of entries a circle.
constexpr std::uint64_t kMostSwapsPerEntry = 64;

}  // namespace

// --- The layer --------------------------------------------------------------

RaySweep::RaySweep(const csg::Scene& scene, const SweepOptions& options)
    : pitch_(options.pitch),
      tie_distance_(options.tie_distance),
      sets_(scene, options.rule),
      tracer_(options.tie_distance, options.merge_distance) {}

void RaySweep::sweep(const ChainBlock& block, std::uint32_t layer,
                     Contours& contours) {
  begin_layer(block, layer);
  while (next_turn_ < turns_.size()) {
    // The next stop is a turn or a change; entering a slab may find changes,
    // those of a column that reaches into it before the column is worked off.
    const double x = std::min(turns_[next_turn_].x, agenda_.next_change());
    if (agenda_.slab_end() <= x + kColumnWidth) {
      agenda_.enter_next_slab();
      look_again(x);
    } else {
      process_column(x);
    }
  }
  tracer_.trace(contours);
  counts_.evaluations = sets_.evaluations();
  counts_.repaired_columns = tracer_.unlinked_ends();
}

void RaySweep::begin_layer(const ChainBlock& block, std::uint32_t layer) {
  points_ = block.points;
  chains_ = block.layer(layer);
  lone_loops_.find(block, layer, sets_);
  turns_ = sorter_.sort(chains_, points_, lone_loops_);
  next_turn_ = 0;
  column_ = 0;
  column_right_ = -kNever;
  status_.begin(chains_.size());
  tracer_.begin();
  if (first_layer_sets_ == 0) first_layer_sets_ = sets_.size();
  if (sets_.size() > std::max(kFewSets, kLayersOfSets * first_layer_sets_) ||
      sets_.cost() > kMostCost) {
    sets_.clear();
    first_layer_sets_ = 0;
  }
  most_cost_ = kMostCost;
  ++counts_.layers;
  counts_.chains += chains_.size();
  for (const Chain& chain : chains_) counts_.points += chain.point_count;
  if (turns_.empty()) return;
  const double low = turns_.front().x;
  const double high = turns_.back().x;
  const std::uint32_t slabs = slab_count(high - low);
  agenda_.begin(low, high, slabs);
  counts_.slabs += slabs;
}

std::uint32_t RaySweep::slab_count(double width) const {
  double count = 0;
  if (pitch_ > 0) {
    count = std::clamp(width / pitch_, 1.0, kMostSlabsOfPitch);
  } else {
    std::size_t points = 0;
    for (const Chain& chain : chains_) points += chain.point_count;
    count = std::clamp(static_cast<double>(points) / kPointsPerSlab,
                       kLeastSlabs, kMostSlabs);
  }
  return static_cast<std::uint32_t>(std::ceil(count));
}

// Looks again at the pairs whose outlook ends in the slab just entered; the
// next stop is at `next_stop`, perhaps just before the slab.
void RaySweep::look_again(double next_stop) {
  // The column before may reach into this slab.
  const double x =
      std::max(std::min(agenda_.slab_start(), next_stop), column_right_);
  agenda_.visit_slab([this, x](const PairRef& pair) {
    const std::uint32_t lower = pair.entry;
    if (!status_.is_alive(lower)) return;
    if (status_[lower].outlook != pair.outlook) return;
    const Outlook outlook = look(lower, status_[lower].above, x);
    assert(outlook.relation == (status_[lower].is_tied ? 0 : 1));
    note_outlook(lower, outlook);
  });
}

// Keeps the sets of the entries on the ray, where thousands of leaves overlap.
void RaySweep::forget_old_sets() {
  std::vector<LeafSets::Id> live;
  for (std::uint32_t e = status_.first(); e != status_.sentinel();
       e = status_[e].above) {
    live.push_back(status_[e].set);
  }
  sets_.keep_only(live);
  auto id = live.begin();
  for (std::uint32_t e = status_.first(); e != status_.sentinel();
       e = status_[e].above) {
    status_[e].set = *id++;
  }
  most_cost_ = std::max(kMostCost, kGrowthOfCost * sets_.cost());
}

// --- The order in a column --------------------------------------------------

void RaySweep::process_column(double x) {
  if (sets_.cost() > most_cost_) forget_old_sets();
  assert(x > column_right_);  // I6
  ++counts_.stops;
  ++column_;
  column_left_ = x;
  column_right_ = x;
  column_swaps_ = 0;
  fresh_.clear();
  touched_.clear();
  touches_.clear();
  const double gather_end = x + kColumnWidth;
  take_turns(gather_end);
  // What the new order brings up inside the column belongs to it: a start and
  // the crossing that it causes 1e-16 later are one stop.
  do {
    settle_order();
  } while (take_changes(gather_end));
  update_sets();
  update_survival();
  split_at_touches();
  tracer_.link_stop();
  check_entries();
}

// Chains that begin and end inside the column are passed over.
void RaySweep::take_turns(double gather_end) {
  // Around lone loops the column changes nothing, so the order on its left will
  // do for them.
  for (std::size_t i = next_turn_;
       i < turns_.size() && turns_[i].x <= gather_end; ++i) {
    const std::uint32_t chain = turns_[i].chain();
    if (lone_loops_.is_lone(chain)) pass_lone_loop(chain);
  }
  started_.clear();
  for (; next_turn_ < turns_.size() && turns_[next_turn_].x <= gather_end;
       ++next_turn_) {
    const Turn& turn = turns_[next_turn_];
    if (lone_loops_.is_lone(turn.chain())) continue;
    column_right_ = std::max(column_right_, turn.x);
    const std::uint32_t entry = turn.chain();
    if (turn.is_end()) {
      if (status_.is_alive(entry)) end_chain(entry);
      continue;
    }
    const double end = chains_[entry].points_in(points_).back().x;
    if (end > gather_end) started_.push_back(entry);
  }
  for (const std::uint32_t entry : started_) start_chain(entry);
}

// Of a lone loop all is boundary of the solid, or nothing.
void RaySweep::pass_lone_loop(std::uint32_t chain) {
  const bool is_lower = lone_loops_.is_lower(chain);
  const Chain& lower = chains_[is_lower ? chain : chain + 1];
  const Chain& upper = chains_[is_lower ? chain + 1 : chain];
  const std::span<const Vec2> points = lower.points_in(points_);
  const double y = points.front().y;
  std::uint32_t below = status_.find_near(y, column_left_);
  while (below != status_.sentinel() && status_.y_at(below, column_left_) > y) {
    below = status_[below].below;
  }
  for (std::uint32_t above = status_[below].above;
       above != status_.sentinel() && status_.y_at(above, column_left_) <= y;
       above = status_[below].above) {
    below = above;
  }
  const LeafSets::Id around = status_[below].set;
  const LeafSets::Id within =
      sets_.after(around, sets_.step_of(lower.instance, lower.winding));
  const int direction = static_cast<int>(sets_.value(within)) -
                        static_cast<int>(sets_.value(around));
  if (direction == 0) return;
  tracer_.add_loop(points, upper.points_in(points_),
                   static_cast<std::int8_t>(direction));
}

void RaySweep::end_chain(std::uint32_t number) {
  Entry& entry = status_[number];
  if (entry.survival != 0) {
    end_piece(entry);
    note_disorder_before(entry.below, number);
    note_disorder_before(number, entry.above);
    entry.survival = 0;
  }
  const std::uint32_t below = entry.below;
  const std::uint32_t above = entry.above;
  status_.remove(number);
  status_[below].is_tied = false;
  ++status_[below].outlook;
  to_check_.push_back(below);
  touched_.push_back(below);
  touched_.push_back(above);
  status_[above].is_fresh = true;
  fresh_.push_back(above);
}

void RaySweep::start_chain(std::uint32_t number) {
  const Chain& chain = chains_[number];
  const std::span<const Vec2> points = chain.points_in(points_);
  Entry entry;
  entry.cursor = ChainCursor(&points.front(), &points.back());
  entry.first = &points.front();
  entry.step = sets_.step_of(chain.instance, chain.winding);
  entry.is_fresh = true;
  entry.cursor.advance(column_right_);
  const std::uint32_t below = find_place(points.front(), entry.cursor);
  status_[number] = entry;
  status_.insert_above(below, number);
  status_[below].is_tied = false;
  ++status_[below].outlook;
  to_check_.push_back(below);
  to_check_.push_back(number);
  fresh_.push_back(number);
  touched_.push_back(below);
  touched_.push_back(status_[number].above);
}

// Whether the entry lies above a chain that starts with `cursor` at y; where y
// ties, by how they go on.
bool RaySweep::is_above(std::uint32_t number, double y,
                        const ChainCursor& cursor) {
  Entry& entry = status_[number];
  entry.cursor.advance(column_right_);
  const double distance = entry.cursor.y_at(column_right_) - y;
  if (std::abs(distance) > tie_distance_) return distance > 0;
  const Outlook outlook = look_ahead(cursor, entry.cursor, column_right_,
                                     column_right_, tie_distance_);
  return outlook.relation > 0 || (outlook.relation == 0 && distance > 0);
}

// The entry above which a new chain belongs.
std::uint32_t RaySweep::find_place(const Vec2& point,
                                   const ChainCursor& cursor) {
  const double y = cursor.y_at(column_right_);
  const std::uint32_t sentinel = status_.sentinel();
  std::uint32_t below = status_.find_near(point.y, column_right_);
  while (below != sentinel && is_above(below, y, cursor)) {
    below = status_[below].below;
  }
  for (;;) {
    const std::uint32_t above = status_[below].above;
    if (above == sentinel || is_above(above, y, cursor)) return below;
    below = above;
  }
}

bool RaySweep::take_changes(double gather_end) {
  bool is_any = false;
  while (agenda_.next_change() <= gather_end) {
    const double x = agenda_.next_change();
    const PairRef pair = agenda_.take_change();
    if (!status_.is_alive(pair.entry)) continue;
    if (status_[pair.entry].outlook != pair.outlook) continue;
    column_right_ = std::max(column_right_, x);
    ++status_[pair.entry].outlook;
    to_check_.push_back(pair.entry);
    touches_.push_back(pair.entry);
    is_any = true;
  }
  return is_any;
}

// Puts new neighbours in the order that holds right of the column.
void RaySweep::settle_order() {
  while (!to_check_.empty()) {
    const std::uint32_t lower = to_check_.back();
    to_check_.pop_back();
    const std::uint32_t sentinel = status_.sentinel();
    if (!status_.is_alive(lower)) continue;
    if (status_[lower].settled == status_[lower].outlook) continue;
    const std::uint32_t upper = status_[lower].above;
    if (upper == sentinel) {
      set_tie(lower, false);
      continue;
    }
    Outlook outlook = look(lower, upper, column_right_);
    if (outlook.relation < 0) {
      const std::uint64_t most = kMostSwapsPerEntry * chains_.size();
      if (++column_swaps_ <= most) {
        swap_with_above(lower);
        continue;
      }
      if (column_swaps_ == most + 1) ++counts_.capped_columns;
      outlook = {};
    }
    set_tie(lower, outlook.relation == 0);
    note_outlook(lower, outlook);
    status_[lower].settled = status_[lower].outlook;
  }
}

void RaySweep::swap_with_above(std::uint32_t lower) {
  const std::uint32_t upper = status_[lower].above;
  const std::uint32_t below = status_[lower].below;
  touched_.push_back(below);
  touched_.push_back(status_[upper].above);
  note_crossing(status_[lower], status_[upper]);
  status_.swap_with_above(lower);
  for (const std::uint32_t entry : {below, upper, lower}) {
    status_[entry].is_tied = false;
    ++status_[entry].outlook;
    to_check_.push_back(entry);
  }
  for (const std::uint32_t entry : {lower, upper}) {
    status_[entry].is_fresh = true;
    fresh_.push_back(entry);
    touched_.push_back(entry);
  }
}

// Where two chains cross they have one point, on the flatter one: a steep one's
// y at the rounded x may be far off.
void RaySweep::note_crossing(Entry& a, Entry& b) {
  const bool is_a_steeper =
      std::abs(a.cursor.slope()) > std::abs(b.cursor.slope());
  Entry& steeper = is_a_steeper ? a : b;
  const Entry& flatter = is_a_steeper ? b : a;
  steeper.crossing_y = flatter.cursor.y_at(column_right_);
  steeper.crossing_column = column_;
}

void RaySweep::set_tie(std::uint32_t entry, bool is_tied) {
  if (status_[entry].is_tied == is_tied) return;
  status_[entry].is_tied = is_tied;
  touched_.push_back(entry);
  touched_.push_back(status_[entry].above);
}

// Looks at a pair from x to the end of the slab, in the last one to the end of
// a chain, but past the column of x in any case, so that none is left before
// all of it is known. Where the bands of the chains are apart there is no need
// to look at their points.
Outlook RaySweep::look(std::uint32_t lower, std::uint32_t upper, double x) {
  Entry& a = status_[lower];
  Entry& b = status_[upper];
  a.cursor.advance(x);
  b.cursor.advance(x);
  const double limit = std::max(agenda_.slab_end(), x + kColumnWidth);
  for (Entry* entry : {&a, &b}) {
    if (entry->band_slab != agenda_.slab()) find_band(*entry, limit);
  }
  // From where the segments in hand are both there.
  const double left = std::max(a.cursor.left_x(), b.cursor.left_x());
  const Stretch apart = apart_stretch(a.band, b.band, left, tie_distance_);
  if (apart.end <= std::max(x + kColumnWidth, apart.begin)) {
    return look_ahead(a.cursor, b.cursor, x, limit, tie_distance_);
  }
  return look_outside(a, b, apart, x, limit);
}

// Looks at a pair from x on where it is not known to be apart: before that
// stretch, or behind it, hence at one of the two.
Outlook RaySweep::look_outside(const Entry& a, const Entry& b,
                               const Stretch& apart, double x, double limit) {
  const Band& shorter = a.band.right <= b.band.right ? a.band : b.band;
  if (apart.end < shorter.right) {
    ChainCursor lower = a.cursor;
    ChainCursor upper = b.cursor;
    lower.advance(apart.end);
    upper.advance(apart.end);
    return look_ahead(lower, upper, apart.end, limit, tie_distance_);
  }
  Outlook outlook;
  outlook.horizon = x;
  if (apart.begin > x) {
    outlook = look_ahead(a.cursor, b.cursor, x, std::min(limit, apart.begin),
                         tie_distance_);
  }
  if (outlook.relation > 0 && outlook.change == kNever &&
      outlook.horizon < shorter.right) {
    outlook.horizon = shorter.right;
  }
  if (outlook.horizon == shorter.right && shorter.ends_chain) {
    outlook.horizon = kNever;
  }
  return outlook;
}

void RaySweep::find_band(Entry& entry, double limit) {
  entry.band_slab = agenda_.slab();
  const ChainCursor& cursor = entry.cursor;
  entry.band = Band(cursor.left(), cursor.slope(), cursor.last(), limit);
}

void RaySweep::note_outlook(std::uint32_t lower, const Outlook& outlook) {
  assert(outlook.change > column_right_);  // I6
  agenda_.note({lower, ++status_[lower].outlook}, outlook);
}

}  // namespace lamina::ldni::detail
