#include "ldni/kinetic_ray.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "ldni/detail/chain_builder.h"
#include "ldni/detail/contour_tracer.h"
#include "ldni/detail/leaf_sets.h"
#include "ldni/detail/outlook.h"
#include "ldni/detail/status.h"
#include "ldni/detail/turns.h"
#include "ldni/sample.h"

namespace lamina::ldni {
namespace {

using detail::ChainCursor;
using detail::ContourTracer;
using detail::Entry;
using detail::kNever;
using detail::kNone;
using detail::LeafSets;
using detail::Outlook;
using detail::Status;
using detail::Turn;
using detail::TurnSorter;

// Slabs of a layer where the pitch is left to us: one for so many points of
// its chains, within limits.
constexpr double kPointsPerSlab = 24;
constexpr double kLeastSlabs = 4;
constexpr double kMostSlabs = 4096;
constexpr double kMostSlabsOfPitch = 1 << 16;

// Known sets are forgotten between two layers when they are many: more than
// this, and more than so many times those of the first layer since, so that
// the tables stay in the cache and still serve several layers.
constexpr std::size_t kFewSets = 4096;
constexpr std::size_t kLayersOfSets = 4;

// Points nearer than this [mm] are one where near ties were resolved: what is
// left of faces apart by less than a tie is that small. Else they are one
// where a column can have moved them, kColumnWidth.
constexpr double kResolvedMergeDistance = 1e-8;

// Swaps in one column before it counts as endless: the pairwise order of n
// entries needs at most n²/2; rounding could make it a circle.
constexpr std::uint64_t kMostSwapsPerEntry = 64;

// A pair whose relation changes at x, by its lower entry; stale where the
// stamp is not that of the entry's present outlook.
struct Change {
  double x = 0;
  std::uint32_t entry = 0;
  std::uint32_t outlook = 0;
};
bool comes_later(const Change& a, const Change& b) { return a.x > b.x; }

// A pair to be looked at again in a later slab.
struct Renewal {
  std::uint32_t entry = 0;
  std::uint32_t outlook = 0;
  std::uint32_t next = kNone;  // of the same slab
};

}  // namespace

SweepCounts& SweepCounts::operator+=(const SweepCounts& other) {
  layers += other.layers;
  chains += other.chains;
  points += other.points;
  slabs += other.slabs;
  stops += other.stops;
  evaluations += other.evaluations;
  resolved_layers += other.resolved_layers;
  capped_columns += other.capped_columns;
  repaired_columns += other.repaired_columns;
  return *this;
}

struct KineticRay::State {
  State(const csg::Scene& scene, double pitch_of_rays, double tie, double merge,
        LeafSets::Rule rule)
      : pitch(pitch_of_rays),
        tie_distance(tie),
        sets(scene, rule),
        tracer(tie, merge) {}

  void sweep(const ChainBlock& block, std::uint32_t layer, Contours& contours);
  void begin_layer(const ChainBlock& chain_block,
                   std::span<const Chain> layer_chains);
  void lay_out_slabs(double low, double high);
  void enter_slabs_up_to(double x);
  double slab_start(std::uint32_t number) const {
    return first_slab_x + number * slab_width;
  }

  // One stop.
  void process_column(double x);
  void take_turns(double gather_end);
  void end_chain(std::uint32_t entry);
  void start_chain(std::uint32_t entry);
  void note_disorder_before(std::uint32_t lower, std::uint32_t upper);
  void note_disorder_after(std::uint32_t lower, std::uint32_t upper);
  bool is_above(std::uint32_t entry, double y, const ChainCursor& cursor);
  std::uint32_t find_place(const Vec2& point, const ChainCursor& cursor);
  bool take_changes(double gather_end);
  void settle_order();
  void swap_with_above(std::uint32_t entry);
  void note_crossing(Entry& a, Entry& b);
  void set_tie(std::uint32_t entry, bool is_tied);
  void plan(std::uint32_t entry, const Outlook& outlook);
  Outlook look(std::uint32_t lower, std::uint32_t upper, double x);
  void find_range(Entry& entry, double limit);
  void update_sets();
  void update_sets_from(std::uint32_t entry);
  void update_survival();
  void update_group(std::uint32_t member);
  void change_survival(std::uint32_t entry, std::int8_t survival);
  void split_at_touches();
  void split_piece(Entry& entry);
  void end_piece(Entry& entry);
  void start_piece(Entry& entry);
  ChainCursor cursor_before(const Entry& entry) const;
  // The entry's y on either side of the column.
  double y_before(const Entry& entry, const ChainCursor& before) const {
    return crosses_here(entry) ? entry.crossing_y : before.y_at(column_left);
  }
  double y_after(const Entry& entry) const {
    return crosses_here(entry) ? entry.crossing_y
                               : entry.cursor.y_at(column_right);
  }
  bool crosses_here(const Entry& entry) const {
    return entry.crossing_column == column && column_left == column_right;
  }
  bool is_in_column(double x) const {
    return x >= column_left && x <= column_left + kColumnWidth;
  }
  void check_entries() const;

  const double pitch;
  const double tie_distance;
  SweepCounts counts;
  LeafSets sets;
  std::size_t first_layer_sets = 0;  // known after the first layer; 0: not yet
  Status status;
  TurnSorter sorter;
  ContourTracer tracer;

  // The layer in hand.
  std::span<const Vec2> points;
  std::span<const Chain> chains;
  std::span<const Turn> turns;
  std::size_t next_turn = 0;
  std::vector<Change> changes;  // a heap, the next one in front

  // Slabs between neighbouring rays at the pitch.
  double first_slab_x = 0;
  double slab_width = 0;
  std::uint32_t slab_count = 0;
  std::uint32_t slab = 0;                    // the one that the ray is in
  std::vector<std::uint32_t> renewal_lists;  // first of each slab, into:
  std::vector<Renewal> renewals;

  // The column in hand: what lies in [column_left, column_right] happens at
  // one x. The state on its left holds up to column_left, that on its right
  // from column_right on.
  double column_left = 0;
  double column_right = 0;
  std::uint32_t column = 0;  // number
  std::uint64_t column_swaps = 0;
  std::vector<std::uint32_t> started;
  std::vector<std::uint32_t> to_check;  // lower entries of new pairs
  std::vector<std::uint32_t> fresh;     // entries whose set is in doubt
  std::vector<std::pair<double, std::uint32_t>> fresh_by_y;
  std::vector<std::uint32_t> touched;  // whose survival is in doubt
  std::vector<std::uint32_t> touches;  // lower entries of pairs that touch
};

// Boundary that changes over between tied chains jumps by up to a tie, and may
// run into other boundary there. Such loops are swept once more as one leaf
// that may overlap itself: solid is where they wind around in the positive
// sense, ties are what rounding leaves.
struct KineticRay::Resolver {
  Resolver()
      : state(scene, 0, kColumnWidth, kResolvedMergeDistance,
              LeafSets::Rule::kPositive) {}

  void resolve(Contours& contours) {
    block.layer_count = 1;
    builder.begin(block);
    for (std::size_t i = 0; i < contours.loop_count(); ++i) {
      const auto loop = contours.loop(i);
      builder.loop().assign(loop.begin(), loop.end());
      builder.close_loop(0, 0, 1);
    }
    builder.finish(block);
    state.sweep(block, 0, contours);
  }

  static csg::Scene one_leaf() {
    csg::Scene scene;
    scene.leaves.resize(1);
    scene.leaves[0].may_overlap_itself = true;
    scene.instances.resize(1);
    scene.program.push_back({csg::BooleanOp::kUnion, 0, false, 1});
    return scene;
  }

  csg::Scene scene = one_leaf();
  State state;
  detail::ChainBuilder builder;
  ChainBlock block;
};

KineticRay::KineticRay(const csg::Scene& scene, double pitch)
    : state_(std::make_unique<State>(scene, pitch, kTieDistance, kColumnWidth,
                                     LeafSets::Rule::kNonZero)) {}

KineticRay::~KineticRay() = default;

void KineticRay::sweep(const ChainBlock& block, std::uint32_t layer,
                       Contours& contours) {
  state_->sweep(block, layer, contours);
  if (!state_->tracer.has_jumps()) return;
  if (!resolver_) resolver_ = std::make_unique<Resolver>();
  resolver_->resolve(contours);
  ++state_->counts.resolved_layers;
}

const SweepCounts& KineticRay::counts() const { return state_->counts; }

// --- The layer --------------------------------------------------------------

void KineticRay::State::sweep(const ChainBlock& block, std::uint32_t layer,
                              Contours& contours) {
  begin_layer(block, block.layer(layer));
  while (next_turn < turns.size()) {
    // The next stop is a turn or a change; entering slabs may find changes.
    double x = turns[next_turn].x;
    if (!changes.empty()) x = std::min(x, changes.front().x);
    if (slab + 1 < slab_count && slab_start(slab + 1) <= x) {
      enter_slabs_up_to(x);
      continue;
    }
    process_column(x);
  }
  tracer.trace(contours);
  counts.evaluations = sets.evaluations();
  counts.repaired_columns = tracer.unlinked_ends();
}

void KineticRay::State::begin_layer(const ChainBlock& chain_block,
                                    std::span<const Chain> layer_chains) {
  points = chain_block.points;
  chains = layer_chains;
  turns = sorter.sort(chains, points);
  next_turn = 0;
  changes.clear();
  renewals.clear();
  column = 0;
  column_right = -kNever;
  status.begin(chains.size());
  tracer.begin();
  if (first_layer_sets == 0) first_layer_sets = sets.size();
  if (sets.size() > std::max(kFewSets, kLayersOfSets * first_layer_sets)) {
    sets.clear();
    first_layer_sets = 0;
  }
  ++counts.layers;
  counts.chains += chains.size();
  if (turns.empty()) return;
  lay_out_slabs(turns.front().x, turns.back().x);
}

void KineticRay::State::lay_out_slabs(double low, double high) {
  std::size_t point_count = 0;
  for (const Chain& chain : chains) point_count += chain.point_count;
  counts.points += point_count;
  double count = std::clamp(static_cast<double>(point_count) / kPointsPerSlab,
                            kLeastSlabs, kMostSlabs);
  if (pitch > 0) {
    count = std::clamp((high - low) / pitch, 1.0, kMostSlabsOfPitch);
  }
  slab_count = static_cast<std::uint32_t>(std::ceil(count));
  first_slab_x = low;
  slab_width = (high - low) / slab_count;
  slab = 0;
  renewal_lists.assign(slab_count, kNone);
  counts.slabs += slab_count;
}

// Looks again at the pairs whose outlook ends in the slabs up to x.
void KineticRay::State::enter_slabs_up_to(double x) {
  while (slab + 1 < slab_count && slab_start(slab + 1) <= x) {
    ++slab;
    const double start = slab_start(slab);
    std::uint32_t i = renewal_lists[slab];
    while (i != kNone) {
      const Renewal renewal = renewals[i];
      i = renewal.next;
      const std::uint32_t lower = renewal.entry;
      if (!status.is_alive(lower)) continue;
      if (status[lower].outlook != renewal.outlook) continue;
      const std::uint32_t upper = status[lower].above;
      // The column before may reach into this slab.
      const double from = std::max(start, column_right);
      status[lower].cursor.advance(from);
      status[upper].cursor.advance(from);
      const Outlook outlook = look(lower, upper, from);
      assert(outlook.relation == (status[lower].is_tied ? 0 : 1));
      plan(lower, outlook);
      if (outlook.change < x) x = outlook.change;
    }
  }
}

// --- The column -------------------------------------------------------------

void KineticRay::State::process_column(double x) {
  ++counts.stops;
  ++column;
  column_left = x;
  column_right = x;
  column_swaps = 0;
  fresh.clear();
  touched.clear();
  touches.clear();
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
  tracer.link_stop();
  check_entries();
}

// Chains that begin and end inside the column are passed over.
void KineticRay::State::take_turns(double gather_end) {
  started.clear();
  for (; next_turn < turns.size() && turns[next_turn].x <= gather_end;
       ++next_turn) {
    const Turn& turn = turns[next_turn];
    column_right = std::max(column_right, turn.x);
    const std::uint32_t entry = turn.chain();
    if (turn.is_end()) {
      if (status.is_alive(entry)) end_chain(entry);
      continue;
    }
    const Chain& chain = chains[entry];
    const Vec2& end = points[chain.first_point + chain.point_count - 1];
    if (end.x > gather_end) started.push_back(entry);
  }
  for (const std::uint32_t entry : started) start_chain(entry);
}

void KineticRay::State::end_chain(std::uint32_t number) {
  Entry& entry = status[number];
  if (entry.survival != 0) {
    end_piece(entry);
    note_disorder_before(entry.below, number);
    note_disorder_before(number, entry.above);
    entry.survival = 0;
  }
  const std::uint32_t below = entry.below;
  const std::uint32_t above = entry.above;
  status.remove(number);
  status[below].is_tied = false;
  ++status[below].outlook;
  to_check.push_back(below);
  touched.push_back(below);
  touched.push_back(above);
  status[above].is_fresh = true;
  fresh.push_back(above);
}

// Neighbours that both survive may be out of order by less than a tie: on the
// left of the column, where a chain is about to end, or on its right.
void KineticRay::State::note_disorder_before(std::uint32_t lower,
                                             std::uint32_t upper) {
  const Entry& a = status[lower];
  const Entry& b = status[upper];
  if (a.survival == 0 || b.survival == 0 || a.is_tied) return;
  const double distance =
      y_before(b, cursor_before(b)) - y_before(a, cursor_before(a));
  if (distance <= -kColumnWidth) tracer.note_jump();
}

void KineticRay::State::note_disorder_after(std::uint32_t lower,
                                            std::uint32_t upper) {
  if (lower == status.sentinel() || upper == status.sentinel()) return;
  const Entry& a = status[lower];
  const Entry& b = status[upper];
  if (a.survival == 0 || b.survival == 0 || a.is_tied) return;
  const double distance =
      status.y_at(upper, column_right) - status.y_at(lower, column_right);
  if (distance <= -kColumnWidth) tracer.note_jump();
}

void KineticRay::State::start_chain(std::uint32_t number) {
  const Chain& chain = chains[number];
  const Vec2* first = &points[chain.first_point];
  Entry entry;
  entry.cursor = ChainCursor(first, first + chain.point_count - 1);
  entry.first = first;
  entry.step = sets.step_of(chain.instance, chain.winding);
  entry.is_fresh = true;
  entry.cursor.advance(column_right);
  const std::uint32_t below = find_place(*first, entry.cursor);
  status[number] = entry;
  status.insert_above(below, number);
  status[below].is_tied = false;
  ++status[below].outlook;
  to_check.push_back(below);
  to_check.push_back(number);
  fresh.push_back(number);
  touched.push_back(below);
  touched.push_back(status[number].above);
}

// Whether the entry lies above a chain that starts with `cursor` at y; where y
// ties, by how they go on.
bool KineticRay::State::is_above(std::uint32_t number, double y,
                                 const ChainCursor& cursor) {
  Entry& entry = status[number];
  entry.cursor.advance(column_right);
  const double distance = entry.cursor.y_at(column_right) - y;
  if (std::abs(distance) > tie_distance) return distance > 0;
  const Outlook outlook = detail::look_ahead(cursor, entry.cursor, column_right,
                                             column_right, tie_distance);
  return outlook.relation > 0 || (outlook.relation == 0 && distance > 0);
}

// The entry above which a new chain belongs.
std::uint32_t KineticRay::State::find_place(const Vec2& point,
                                            const ChainCursor& cursor) {
  const double y = cursor.y_at(column_right);
  const std::uint32_t sentinel = status.sentinel();
  std::uint32_t below = status.find_near(point.y, column_right);
  while (below != sentinel && is_above(below, y, cursor)) {
    below = status[below].below;
  }
  for (;;) {
    const std::uint32_t above = status[below].above;
    if (above == sentinel || is_above(above, y, cursor)) return below;
    below = above;
  }
}

bool KineticRay::State::take_changes(double gather_end) {
  bool is_any = false;
  while (!changes.empty() && changes.front().x <= gather_end) {
    const Change change = changes.front();
    std::pop_heap(changes.begin(), changes.end(), comes_later);
    changes.pop_back();
    if (!status.is_alive(change.entry)) continue;
    if (status[change.entry].outlook != change.outlook) continue;
    column_right = std::max(column_right, change.x);
    to_check.push_back(change.entry);
    touches.push_back(change.entry);
    is_any = true;
  }
  return is_any;
}

// Puts new neighbours in the order that holds right of the column.
void KineticRay::State::settle_order() {
  while (!to_check.empty()) {
    const std::uint32_t lower = to_check.back();
    to_check.pop_back();
    const std::uint32_t sentinel = status.sentinel();
    if (lower == sentinel || !status.is_alive(lower)) continue;
    const std::uint32_t upper = status[lower].above;
    if (upper == sentinel) {
      set_tie(lower, false);
      continue;
    }
    status[lower].cursor.advance(column_right);
    status[upper].cursor.advance(column_right);
    Outlook outlook = look(lower, upper, column_right);
    if (outlook.relation < 0) {
      if (++column_swaps <= kMostSwapsPerEntry * chains.size()) {
        swap_with_above(lower);
        continue;
      }
      if (column_swaps == kMostSwapsPerEntry * chains.size() + 1) {
        ++counts.capped_columns;
      }
      outlook = {};
    }
    set_tie(lower, outlook.relation == 0);
    plan(lower, outlook);
  }
}

void KineticRay::State::swap_with_above(std::uint32_t lower) {
  const std::uint32_t upper = status[lower].above;
  const std::uint32_t below = status[lower].below;
  touched.push_back(below);
  touched.push_back(status[upper].above);
  note_crossing(status[lower], status[upper]);
  status.swap_with_above(lower);
  for (const std::uint32_t entry : {below, upper, lower}) {
    status[entry].is_tied = false;
    ++status[entry].outlook;
    to_check.push_back(entry);
  }
  for (const std::uint32_t entry : {lower, upper}) {
    status[entry].is_fresh = true;
    fresh.push_back(entry);
    touched.push_back(entry);
  }
}

// Where two chains cross they have one point, on the flatter one: a steep one's
// y at the rounded x may be far off.
void KineticRay::State::note_crossing(Entry& a, Entry& b) {
  const bool is_a_steeper =
      std::abs(a.cursor.slope()) > std::abs(b.cursor.slope());
  Entry& steeper = is_a_steeper ? a : b;
  const Entry& flatter = is_a_steeper ? b : a;
  steeper.crossing_y = flatter.cursor.y_at(column_right);
  steeper.crossing_column = column;
}

void KineticRay::State::set_tie(std::uint32_t entry, bool is_tied) {
  if (status[entry].is_tied == is_tied) return;
  status[entry].is_tied = is_tied;
  touched.push_back(entry);
  touched.push_back(status[entry].above);
}

// Looks at a pair from x to the end of the slab, in the last one to the end of
// a chain. Chains whose ranges are apart
// there need no look at their points.
Outlook KineticRay::State::look(std::uint32_t lower, std::uint32_t upper,
                                double x) {
  const double limit = slab + 1 == slab_count ? kNever : slab_start(slab + 1);
  Entry& a = status[lower];
  Entry& b = status[upper];
  find_range(a, limit);
  find_range(b, limit);
  if (a.high + tie_distance < b.low) {
    Outlook outlook;
    outlook.horizon = std::min(a.range_end, b.range_end);
    return outlook;
  }
  return detail::look_ahead(a.cursor, b.cursor, x, limit, tie_distance);
}

void KineticRay::State::find_range(Entry& entry, double limit) {
  if (entry.range_slab == slab) return;
  entry.range_slab = slab;
  const Vec2* point = entry.cursor.left();
  const Vec2* last = entry.cursor.last();
  entry.low = point->y;
  entry.high = point->y;
  do {
    ++point;
    entry.low = std::min(entry.low, point->y);
    entry.high = std::max(entry.high, point->y);
  } while (point->x < limit && point != last);
  entry.range_end = point == last ? kNever : point->x;
}

// Notes when the pair above `lower` is to be looked at next.
void KineticRay::State::plan(std::uint32_t lower, const Outlook& outlook) {
  const std::uint32_t stamp = ++status[lower].outlook;
  if (outlook.change < kNever) {
    // I6: progress. A change lies strictly right of the column.
    assert(outlook.change > column_right);
    changes.push_back({outlook.change, lower, stamp});
    std::push_heap(changes.begin(), changes.end(), comes_later);
  } else if (outlook.horizon < kNever) {
    const double slabs = (outlook.horizon - first_slab_x) / slab_width;
    auto when = std::min(static_cast<std::uint32_t>(slabs), slab_count - 1);
    while (slab_start(when) >= outlook.horizon) --when;
    when = std::max(when, slab + 1);
    renewals.push_back({lower, stamp, renewal_lists[when]});
    renewal_lists[when] = static_cast<std::uint32_t>(renewals.size() - 1);
  }
}

// --- Sets and survival ------------------------------------------------------

void KineticRay::State::update_sets() {
  // Bottom-up, so that no set is made from one that is about to change.
  if (fresh.size() > 2) {
    fresh_by_y.clear();
    for (const std::uint32_t entry : fresh) {
      if (!status.is_alive(entry)) continue;
      fresh_by_y.push_back({status.y_at(entry, column_right), entry});
    }
    std::sort(fresh_by_y.begin(), fresh_by_y.end());
    fresh.clear();
    for (const auto& [y, entry] : fresh_by_y) fresh.push_back(entry);
  }
  for (const std::uint32_t entry : fresh) {
    if (status.is_alive(entry) && status[entry].is_fresh) {
      update_sets_from(entry);
    }
  }
}

// I2: the set above an entry is the set below it after the entry's step.
// Restores that from `entry` up to where nothing changes any more, so that a
// vertical wall costs only the entries that it spans.
void KineticRay::State::update_sets_from(std::uint32_t entry) {
  while (status[status[entry].below].is_fresh &&
         status[entry].below != status.sentinel()) {
    entry = status[entry].below;
  }
  LeafSets::Id set = status[status[entry].below].set;
  for (; entry != status.sentinel(); entry = status[entry].above) {
    Entry& e = status[entry];
    set = sets.after(set, e.step);
    if (!e.is_fresh && e.set == set) return;
    e.is_fresh = false;
    e.set = set;
    e.value = sets.value(set);
    touched.push_back(entry);
  }
}

void KineticRay::State::update_survival() {
  for (const std::uint32_t entry : touched) {
    if (entry == status.sentinel() || !status.is_alive(entry)) continue;
    if (status[entry].column != column) update_group(entry);
  }
}

// Tied entries are one curve: the solid below the lowest against that above
// the highest decides, and one member stands for all.
void KineticRay::State::update_group(std::uint32_t member) {
  const std::uint32_t sentinel = status.sentinel();
  std::uint32_t first = member;
  while (status[first].below != sentinel &&
         status[status[first].below].is_tied) {
    first = status[first].below;
  }
  std::uint32_t last = first;
  while (status[last].is_tied) last = status[last].above;
  const bool below = status[status[first].below].value;
  const bool above = status[last].value;
  const auto survival = static_cast<std::int8_t>(above - below);

  // Whoever stood for it before goes on.
  std::uint32_t chosen = first;
  if (survival != 0) {
    for (std::uint32_t e = first;; e = status[e].above) {
      if (status[e].survival == survival) {
        chosen = e;
        break;
      }
      if (e == last) break;
    }
  }
  for (std::uint32_t e = first;; e = status[e].above) {
    status[e].column = column;
    change_survival(e, e == chosen ? survival : std::int8_t{0});
    if (e == last) break;
  }
}

void KineticRay::State::change_survival(std::uint32_t number,
                                        std::int8_t survival) {
  Entry& entry = status[number];
  if (entry.survival == survival) return;
  if (entry.survival != 0) end_piece(entry);
  entry.survival = survival;
  if (survival != 0) start_piece(entry);
}

// --- Pieces -----------------------------------------------------------------

// Cuts boundary that goes on straight through the column where it touches
// another in a point, so that the tracer sees the touch, and where it runs
// along the column past others.
void KineticRay::State::split_at_touches() {
  for (const std::uint32_t lower : touches) {
    if (!status.is_alive(lower)) continue;
    const std::uint32_t upper = status[lower].above;
    if (upper == status.sentinel()) continue;
    Entry& a = status[lower];
    Entry& b = status[upper];
    if (a.survival == 0 || b.survival == 0) continue;
    const double distance =
        status.y_at(upper, column_right) - status.y_at(lower, column_right);
    if (distance <= -kColumnWidth) tracer.note_jump();
    if (std::abs(distance) >= kColumnWidth) continue;
    split_piece(a);
    split_piece(b);
  }
  for (const std::uint32_t number : touched) {
    if (number == status.sentinel() || !status.is_alive(number)) continue;
    Entry& entry = status[number];
    if (entry.survival == 0) continue;
    note_disorder_after(entry.below, number);
    note_disorder_after(number, entry.above);
    if (entry.split_column == column) continue;
    entry.cursor.advance(column_right);
    const double y = y_after(entry);
    if (tracer.has_end_near(y) ||
        std::abs(y_before(entry, cursor_before(entry)) - y) >= kColumnWidth) {
      split_piece(entry);
    }
  }
}

void KineticRay::State::split_piece(Entry& entry) {
  if (entry.split_column == column) return;
  end_piece(entry);
  start_piece(entry);
}

// The entry's cursor where it meets the column from the left.
ChainCursor KineticRay::State::cursor_before(const Entry& entry) const {
  const Vec2* left = entry.cursor.left();
  const Vec2* last = entry.cursor.last();
  while (left != entry.first && left->x >= column_left) --left;
  while (left + 1 != last && left[1].x < column_left) ++left;
  return {left, last};
}

// I5: where a chain starts or ends in the column, its turn is the point,
// exactly. Only a chain that runs along the column is taken where the order of
// its side holds, so that the region stays the union of trapezoids between
// columns (I4).
void KineticRay::State::end_piece(Entry& entry) {
  const ChainCursor cursor = cursor_before(entry);
  const Vec2* last = cursor.last();
  const double y = y_before(entry, cursor);
  Vec2 point(column_left, y);
  if (is_in_column(last->x) && std::abs(last->y - y) < kColumnWidth) {
    point = *last;
  }
  tracer.end_piece(entry.piece, point, y, cursor.left());
  entry.split_column = column;
}

void KineticRay::State::start_piece(Entry& entry) {
  entry.cursor.advance(column_right);
  const Vec2* left = entry.cursor.left();
  const double y = y_after(entry);
  Vec2 point(column_right, y);
  if (is_in_column(entry.first->x) &&
      std::abs(entry.first->y - y) < kColumnWidth) {
    point = *entry.first;
  }
  entry.piece = tracer.start_piece(point, y, left, entry.survival);
  entry.split_column = column;
}

// I1 and I2 at the top (every leaf is left as often as it is entered), I2 in
// between, I3 (neighbours are apart or tied). Debug builds only.
void KineticRay::State::check_entries() const {
#ifndef NDEBUG
  const std::uint32_t sentinel = status.sentinel();
  for (std::uint32_t e = status.first(); e != sentinel; e = status[e].above) {
    assert(!status[e].is_fresh);
    if (status[e].above == sentinel) assert(status[e].set == LeafSets::kEmpty);
  }
#endif
}

}  // namespace lamina::ldni
