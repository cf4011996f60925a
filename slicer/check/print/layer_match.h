#pragma once
// Proves that a layer is the one below, moved: that its loops pair up with
// those below, and that regions overlap as if they were the same. Most layers
// are like that, and then a ray need not move over all of both
// (layer_overlay.h).
//
// Regions. Loop j above is paired with loop j below. Where
//   1. loops that are not a pair never meet,
//   2. each loop of a pair lies in those loops of either layer in which the
//      other one does, and
//   3. around some place in each region a disc lies in the region of that
//      number in both layers,
// regions of the same number overlap, and no others of a kind do. For let a
// place be in regions i ≠ j of a kind, i above. If neither loop lies in the
// other, they would meet (1). If i lies in j, there is a loop k around i in j,
// of the other kind; by (2) loop i above lies in loop k below, so the place
// does and is not in region j. If j lies in i it is the same the other way
// around.
//
// Overhangs. A walk along both loops of a pair at once leads from rung to rung:
// a rung is a segment from a place on the one to a place on the other, and
// between two rungs both go straight. Where no rung is longer than the reach,
// the one loop moves to the other without crossing a place that is farther than
// that from the loop below. So both wind around such a place alike, and nothing
// hangs over. The walk comes first: it ends early where layers differ.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/lanes.h"
#include "base/vec.h"
#include "plane/contours.h"

namespace lamina::slicer {

// The loops of a layer, with boxes of a few edges each. Holds copies.
class BoxedLoops {
 public:
  using Set = std::uint64_t;  // of loops, a bit each
  static constexpr std::size_t kMostLoops = 64;

  void fill(const plane::Contours& contours);

  std::uint32_t count() const {
    return static_cast<std::uint32_t>(loop_boxes_.size());
  }
  // Each with its first point once more at its end.
  std::span<const Vec2> loop(std::uint32_t i) const {
    return std::span(points_).subspan(begins_[i], begins_[i + 1] - begins_[i]);
  }

  // The loops around a place, without one of them.
  Set around(Vec2 place, std::uint32_t left_out) const;
  // Whether the region within these loops, and no others, holds all that is
  // nearer to the place than the radius [mm].
  bool holds_disc(Set loops, Vec2 place, double radius) const;
  bool meets(std::uint32_t i, const BoxedLoops& other, std::uint32_t j) const;
  // The middle of the longest part of region i on an upright line that parts
  // its box at a share of its width.
  //
  // holes  the loops that lie in the region
  Vec2 place_in(std::uint32_t i, Set holes, double share) const;

 private:
  struct Box {
    Lanes low;
    Lanes high;

    void add(Lanes point) {
      low = least(low, point);
      high = greatest(high, point);
    }
    bool is_apart(const Box& other) const {
      return holds_for_any((low > other.high) | (other.low > high));
    }
  };
  static constexpr std::size_t kEdgesPerBox = 16;

  std::span<const Box> boxes_of(std::uint32_t i) const {
    return std::span(boxes_).subspan(first_boxes_[i],
                                     first_boxes_[i + 1] - first_boxes_[i]);
  }
  // The points from the first to the last edge in box k of loop i.
  std::span<const Vec2> edges_of(std::uint32_t i, std::size_t k) const {
    const std::span<const Vec2> points = loop(i).subspan(k * kEdgesPerBox);
    return points.first(std::min(kEdgesPerBox + 1, points.size()));
  }
  static bool do_meet(std::span<const Vec2> a, const Box& box_a,
                      std::span<const Vec2> b, const Box& box_b);
  // How often loop i goes around the place; nothing where it comes nearer than
  // that.
  std::optional<int> winding_number(std::uint32_t i, Vec2 place,
                                    double margin) const;

  std::vector<Vec2> points_;
  std::vector<std::size_t> begins_;  // of the loops in points_, and the end
  std::vector<Box> boxes_;
  std::vector<std::size_t> first_boxes_;  // of the loops, and the end
  std::vector<Box> loop_boxes_;
};

class LayerMatch {
 public:
  void start(const plane::Contours& layer) { set(layer); }

  // Takes the next layer; false where the proof fails. It must stay until the
  // next call.
  //
  // reach  as of lay_over() [mm]
  bool take(const plane::Contours& layer, double reach);

  // By loop of the layer taken last: the area, signed [mm²], and if the proof
  // succeeded, the region around it.
  const std::vector<double>& areas() const { return above_.areas; }
  const std::vector<std::uint32_t>& around() const { return around_; }

 private:
  struct Side {
    const plane::Contours* contours = nullptr;
    std::vector<double> areas;
    BoxedLoops loops;
    bool is_filled = false;

    void fill();
  };

  void set(const plane::Contours& layer);
  bool is_proven(double reach);
  bool walk(std::uint32_t i, double reach);
  bool are_regions_matched();
  bool nests_alike(std::uint32_t i);
  bool is_in_both(std::uint32_t i, Vec2 place) const;
  bool has_place_in_both(std::uint32_t i);

  Side below_;
  Side above_;
  // Layers that differ follow each other: after so many failures the proof is
  // not tried for as many layers, kMostSkips at most.
  static constexpr int kMostSkips = 16;
  int failures_ = 0;
  int skips_ = 0;
  std::vector<BoxedLoops::Set> outer_;  // the loops around each loop above
  std::vector<std::uint32_t> around_;
  std::vector<Vec2> places_;        // one in each region
  std::vector<Vec2> walked_below_;  // the pair of loops, from the first rung on
  std::vector<Vec2> walked_above_;
};

}  // namespace lamina::slicer
