#pragma once
// The status of the moving ray: its samples, one of each chain that it
// crosses, in the order of y.
//
// A list linked both ways holds the order, so that a swap or an insertion
// costs nothing however many samples the ray carries. To find the place of a
// new chain, an array of the entries in an earlier order is searched by
// halves, then the list from there; the array is renewed when it is too old.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "ldni/section/leaf_section.h"
#include "ldni/sweep/detail/band.h"
#include "ldni/sweep/detail/leaf_sets.h"

namespace lamina::ldni::detail {

inline constexpr std::uint32_t kNone = 0xffffffff;

// A segment of a chain, and how to go on along the chain.
class ChainCursor {
 public:
  ChainCursor() = default;
  ChainCursor(const Vec2* first, const Vec2* last) : left_(first), last_(last) {
    set_slope();
  }

  const Vec2* left() const { return left_; }
  const Vec2* last() const { return last_; }  // the chain's last point
  double left_x() const { return left_->x; }
  double right_x() const { return left_[1].x; }
  double slope() const { return slope_; }
  bool is_last_segment() const { return left_ + 1 == last_; }

  void step() {
    ++left_;
    set_slope();
  }
  // Moves on until the segment holds x or what lies right of it; stays on the
  // last segment.
  void advance(double x) {
    if (left_[1].x > x || is_last_segment()) return;
    do {
      ++left_;
    } while (left_[1].x <= x && !is_last_segment());
    set_slope();
  }

  // y of the segment's line at x; vertices give their own y exactly.
  double y_at(double x) const {
    if (x == left_[1].x) return left_[1].y;
    return left_->y + (x - left_->x) * slope_;
  }

 private:
  void set_slope() {
    slope_ = (left_[1].y - left_->y) / (left_[1].x - left_->x);
  }

  const Vec2* left_ = nullptr;
  const Vec2* last_ = nullptr;
  double slope_ = 0;
};

// A sample of the moving ray, numbered as the layer's chains are. What it says
// of an interval is said of the one above it, up to the next entry.
//
// What every stop looks at stands in front, in one line of the cache.
struct alignas(64) Entry {
  ChainCursor cursor;
  std::uint32_t below = 0;
  std::uint32_t above = 0;
  LeafSets::Id set = LeafSets::kEmpty;  // leaves that contain the interval
  LeafSets::Step step = 0;              // of passing the chain upwards
  std::uint32_t outlook = 0;      // stamp of the present look at the pair above
  std::uint32_t settled = kNone;  // the stamp of a look that put it in order
  std::uint32_t column = 0;       // the last one that judged its tie group
  std::uint32_t touch_column = 0;  // the last one that looked for touches
  std::uint32_t piece = kNone;     // of the contour, where it survives
  bool is_tied = false;            // with the entry above: the interval is none
  bool is_fresh = false;           // `set` is to be computed anew
  std::int8_t survival = 0;  // +1: the solid's boundary, solid above; -1: below

  Band band;  // that the chain keeps to, as seen in slab band_slab
  std::uint32_t band_slab = kNone;

  const Vec2* first = nullptr;     // the chain's first point
  std::uint32_t split_column = 0;  // the last one that ended or began a piece
  std::uint32_t near_column = 0;   // the last one that cut all near near_y
  double near_y = 0;
  double crossing_y = 0;  // where it crosses a flatter chain in that column
  std::uint32_t crossing_column = 0;
};

class Status {
 public:
  // Empties the ray for a layer with this many chains.
  void begin(std::size_t chain_count);

  // Stands below the first and above the last entry: set empty.
  std::uint32_t sentinel() const { return sentinel_; }
  Entry& operator[](std::uint32_t entry) { return entries_[entry]; }
  const Entry& operator[](std::uint32_t entry) const { return entries_[entry]; }
  // Whether the entry is on the ray; the sentinel is not.
  bool is_alive(std::uint32_t entry) const { return is_alive_[entry] != 0; }
  std::uint32_t first() const { return entries_[sentinel_].above; }

  // Puts the chain, which starts at the ray's present x, above `below`.
  void insert_above(std::uint32_t below, std::uint32_t entry);
  void remove(std::uint32_t entry);
  // Exchanges an entry with the one above it.
  void swap_with_above(std::uint32_t entry);

  // An entry not far from y at x, to begin a search with; the sentinel where
  // the ray is empty. Cursors are moved to x.
  std::uint32_t find_near(double y, double x);

  double y_at(std::uint32_t entry, double x) {
    entries_[entry].cursor.advance(x);
    return entries_[entry].cursor.y_at(x);
  }

 private:
  void renew_order();

  std::vector<Entry> entries_;
  std::vector<std::uint8_t> is_alive_;
  std::uint32_t sentinel_ = 0;
  std::size_t size_ = 0;
  std::vector<std::uint32_t> order_;
  std::size_t changes_ = 0;  // since order_ was renewed
};

}  // namespace lamina::ldni::detail
