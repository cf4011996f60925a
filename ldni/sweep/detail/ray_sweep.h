#pragma once
// One layer's way of the moving ray: from chains to contours.
//
// Between two stops nothing happens. A stop is a **column**: all that lies
// within 1e-9 mm of its first event, for rounding spreads what belongs to one
// x. It is worked off in this order:
//
//   1. take_turns      ended chains leave the status, started ones enter it,
//                      and lone loops are passed over;
//   2. settle_order    new neighbours are put in the order right of the column,
//                      which may bring up changes inside it: again until none;
//   3. update_sets     sets of leaves, from the changes upwards;
//   4. update_survival the boundary: where the solid differs below and above;
//   5. split_at_touches, link_stop: pieces of boundary end and begin, and what
//                      ends and begins is linked.
//
// What follows from what, and where it is kept:
//
// I1  Every leaf has an even number of entries between two columns. Chains come
//     from closed loops (one threshold decides above and below for both faces
//     of an edge), and the ends of a vertical edge have one x exactly.
//     Where one has not, the set above the topmost entry is not empty: counted
//     as an unbalanced column.
// I2  The set above an entry is the set below it after the entry's step; above
//     the topmost entry it is empty. Kept by update_sets_from.
// I3  Between columns neighbours are apart or tied, so the order is constant,
//     so every 1D Boolean there has the same result: one ray proves the slab.
//     Kept by settle_order and the outlooks in the agenda.
// I4  In every column as many ends arrive as depart: they bound the difference
//     of the solid intervals left and right. The region is the union of the
//     trapezoids between columns, and contours close whatever the rounding.
//     An end that finds no partner is counted as a repaired column.
// I5  Every point is a vertex of a leaf's section, a point on an edge of it at
//     a stop, or a crossing of two such edges. Kept by end_piece, start_piece.
// I6  Progress: a change lies strictly right of the column in which it was
//     found. Swaps in a column are capped, and the cap is counted.
//
// All are checked by assertions where they hold, in debug builds. The counts
// are kept in all builds, warned of and told by `--report`.

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "csg/scene.h"
#include "ldni/section/contours.h"
#include "ldni/section/leaf_section.h"
#include "ldni/sweep/detail/agenda.h"
#include "ldni/sweep/detail/contour_tracer.h"
#include "ldni/sweep/detail/leaf_sets.h"
#include "ldni/sweep/detail/lone_loops.h"
#include "ldni/sweep/detail/outlook.h"
#include "ldni/sweep/detail/status.h"
#include "ldni/sweep/detail/turns.h"
#include "ldni/sweep/sweep_counts.h"

namespace lamina::ldni::detail {

struct SweepOptions {
  double pitch = 0;           // of the look-ahead rays [mm]; 0 = auto
  double tie_distance = 0;    // [mm]
  double merge_distance = 0;  // of points of a loop [mm]
  LeafSets::Rule rule = LeafSets::Rule::kNonZero;
};

class RaySweep {
 public:
  RaySweep(const csg::Scene& scene, const SweepOptions& options);

  // Replaces `contours` by the loops of layer `layer` of `block`.
  void sweep(const ChainBlock& block, std::uint32_t layer, Contours& contours);

  // Whether boundary of the last layer may run into other boundary, by less
  // than a tie: it changed over between tied chains that are not the same up
  // to rounding, or passed a chain that ties.
  bool has_jumps() const { return tracer_.has_jumps(); }

  SweepCounts& counts() { return counts_; }
  const SweepCounts& counts() const { return counts_; }

 private:
  // The layer.
  void begin_layer(const ChainBlock& block, std::uint32_t layer);
  std::uint32_t slab_count(double width) const;
  void look_again(double next_stop);
  void forget_old_sets();

  // The order in a column.
  void process_column(double x);
  void take_turns(double gather_end);
  void pass_lone_loop(std::uint32_t chain);
  void start_chain(std::uint32_t number);
  void end_chain(std::uint32_t number);
  std::uint32_t find_place(const Vec2& point, const ChainCursor& cursor);
  bool is_above(std::uint32_t number, double y, const ChainCursor& cursor);
  bool take_changes(double gather_end);
  void settle_order();
  void swap_with_above(std::uint32_t lower);
  void note_crossing(Entry& a, Entry& b);
  void set_tie(std::uint32_t entry, bool is_tied);
  Outlook look(std::uint32_t lower, std::uint32_t upper, double x);
  Outlook look_outside(const Entry& a, const Entry& b, const Stretch& apart,
                       double x, double limit);
  void find_band(Entry& entry, double limit);
  void note_outlook(std::uint32_t lower, const Outlook& outlook);

  // The boundary in a column (ray_boundary.cpp).
  void update_sets();
  void update_sets_from(std::uint32_t entry);
  void update_survival();
  void update_group(std::uint32_t member);
  void change_survival(Entry& entry, std::int8_t survival);
  void split_at_touches();
  bool meets_boundary(std::uint32_t number, double y);
  void split_all_near(std::uint32_t number, double y);
  void split_piece(Entry& entry);
  void note_disorder_before(std::uint32_t lower, std::uint32_t upper);
  void note_disorder_after(std::uint32_t lower, std::uint32_t upper);
  template <typename YOf>
  void note_disorder(std::uint32_t lower, std::uint32_t upper, const YOf& y_of);
  void end_piece(Entry& entry);
  void start_piece(Entry& entry);
  void note_moved_end(const ChainCursor& cursor, const Vec2& point);
  void check_entries();

  // The entry's segment and y where it meets the column from the left, and y
  // where it leaves it to the right.
  ChainCursor cursor_before(const Entry& entry) const;
  double y_before(const Entry& entry) const {
    if (crosses_here(entry)) return entry.crossing_y;
    const ChainCursor& cursor = entry.cursor;
    if (cursor.left_x() < column_left_ && cursor.right_x() >= column_left_) {
      return cursor.y_at(column_left_);
    }
    return cursor_before(entry).y_at(column_left_);
  }
  double y_after(Entry& entry) const {
    entry.cursor.advance(column_right_);
    return crosses_here(entry) ? entry.crossing_y
                               : entry.cursor.y_at(column_right_);
  }
  bool crosses_here(const Entry& entry) const {
    return entry.crossing_column == column_ && column_left_ == column_right_;
  }
  bool is_in_column(double x) const {
    return x >= column_left_ && x <= column_left_ + kColumnWidth;
  }

  const double pitch_;
  const double tie_distance_;
  SweepCounts counts_;
  LeafSets sets_;
  std::size_t first_layer_sets_ = 0;  // known after the first layer; 0: not yet
  std::size_t most_cost_ = 0;         // of sets, before old ones are forgotten
  Status status_;
  Agenda agenda_;
  LoneLoops lone_loops_;
  TurnSorter sorter_;
  ContourTracer tracer_;

  // The layer in hand.
  std::span<const Vec2> points_;
  std::span<const Chain> chains_;
  std::span<const Turn> turns_;
  std::size_t next_turn_ = 0;

  // The column in hand. The state on its left holds up to column_left_, that
  // on its right from column_right_ on; with one event the two are the same.
  double column_left_ = 0;
  double column_right_ = 0;
  std::uint32_t column_ = 0;  // number
  std::uint64_t column_swaps_ = 0;
  std::vector<std::uint32_t> started_;
  std::vector<std::uint32_t> to_check_;  // lower entries of new pairs
  std::vector<std::uint32_t> fresh_;     // entries whose set is in doubt
  std::vector<std::pair<double, std::uint32_t>> fresh_by_y_;
  std::vector<std::uint32_t> touched_;  // whose survival is in doubt
  std::vector<std::uint32_t> touches_;  // lower entries of pairs that may touch
};

}  // namespace lamina::ldni::detail
