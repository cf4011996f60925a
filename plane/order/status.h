#pragma once
// The status of the moving ray (Bentley and Ottmann 1979): one entry for each
// chain that the ray crosses, in the order of y.
//
// A list linked both ways leads from neighbour to neighbour; a balanced tree
// over it finds the place of a new chain in O(log n) steps.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "plane/order/band.h"
#include "plane/order/chain_cursor.h"
#include "plane/order/order_tree.h"
#include "plane/program/program_states.h"

namespace lamina::plane {

inline constexpr std::uint32_t kNone = 0xffffffff;

// Where a chain crosses the ray. Entries have the numbers of the layer's
// chains. An entry also stands for the gap above it, up to the next entry.
//
// The fields that every event point reads come first, in one cache line.
struct alignas(64) Entry {
  ChainCursor cursor;
  std::uint32_t below = 0;
  std::uint32_t above = 0;
  ProgramStates::State state = ProgramStates::kOutside;  // of the gap above
  ProgramStates::Crossing crossing = 0;  // of the chain, upwards
  std::uint32_t stamp = 0;               // of the certificate of the pair above
  std::uint32_t settled = kNone;         // the stamp that put the pair in order
  std::uint32_t side_cluster = 0;   // the last one that judged its tie group
  std::uint32_t touch_cluster = 0;  // the last one that looked for touches
  std::uint32_t arc = kNone;        // of the boundary, where side is not 0
  bool is_tied = false;             // with the entry above: there is no gap
  bool is_stale = false;            // `state` has to be found anew
  std::int8_t side = 0;  // of the boundary: +1 solid above, -1 below, 0 none

  Band band;  // around the chain, as seen in slab band_slab
  std::uint32_t band_slab = kNone;

  const Vec2* first = nullptr;      // the chain's first point
  std::uint32_t split_cluster = 0;  // the last one that ended or began an arc
  std::uint32_t near_cluster = 0;   // the last one that split all near near_y
  double near_y = 0;
  double crossing_y = 0;  // where it crosses a flatter chain in that cluster
  std::uint32_t crossing_cluster = 0;
};

class Status {
 public:
  // Empties the ray for a layer with this many chains.
  void begin(std::size_t chain_count);

  // Stands below the first and above the last entry, with state kOutside.
  std::uint32_t sentinel() const { return sentinel_; }
  Entry& operator[](std::uint32_t entry) { return entries_[entry]; }
  const Entry& operator[](std::uint32_t entry) const { return entries_[entry]; }
  // Whether the entry is on the ray; the sentinel is not.
  bool is_alive(std::uint32_t entry) const { return tree_.holds(entry); }
  std::uint32_t first() const { return entries_[sentinel_].above; }

  // Puts an entry, whose other fields are set, above `below`.
  void insert_above(std::uint32_t below, std::uint32_t entry);
  void remove(std::uint32_t entry);
  // Exchanges an entry with the one above it.
  void swap_with_above(std::uint32_t entry);

  // The entry of the gap that (x, y) lies in: the highest one that is not
  // above it. Moves cursors to x.
  std::uint32_t find_below(double y, double x);

  // A walk along the ray has visited so many entries.
  void note_walk(std::uint64_t steps) {
    if (steps > kShortWalk) long_walks_ += steps;
  }
  // Steps of the layer's walks, but for short ones, which cost nothing worth
  // counting.
  std::uint64_t long_walks() const { return long_walks_; }

  double y_at(std::uint32_t entry, double x) {
    entries_[entry].cursor.advance(x);
    return entries_[entry].cursor.y_at(x);
  }

 private:
  static constexpr std::uint64_t kShortWalk = 16;

  std::vector<Entry> entries_;
  OrderTree tree_;
  std::uint32_t sentinel_ = 0;
  std::uint64_t long_walks_ = 0;
};

}  // namespace lamina::plane
