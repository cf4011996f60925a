#pragma once
// Stitches arcs of boundary to loops (the bound edges and polygons of Vatti
// 1992).
//
// Where a chain is boundary of the Boolean between two event points, that
// part of it is an arc. An arc has the solid on one side and is walked with
// the solid on the left: to the right where the solid is above, to the left
// where it is below. At an event point arcs end and begin. Their ends, sorted
// by y and joined two by two, are the symmetric difference of the solid
// intervals left and right of the event point, hence the boundary that lies
// in the ray. Each pair joins the head of an arc to the tail of another one
// (I4), so links close to loops whatever the rounding did; rounding can only
// move a point.
//
// Where two pairs meet in a point, solid and empty sectors alternate around it.
// Partners are exchanged so that each pair is linked across a solid sector: so
// regions that touch in a point have loops of their own, and the inside of an
// outer loop less the holes in it is connected. Then a loop may touch itself;
// exchanging partners makes two loops of it.

#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "base/vec.h"
#include "plane/contours.h"
#include "plane/sweep/loop_pen.h"
#include "plane/sweep/sweep_options.h"

namespace lamina::plane {

// How far [tie distances] boundary may jump between tied chains: groups of
// ties can be a few ties wide.
constexpr double kMostJump = 4;

class Stitcher {
 public:
  // Ends on one side of an event point nearer than a tie could tie.
  explicit Stitcher(const SweepOptions& options)
      : tie_distance_(options.tie_distance),
        pen_(options.merge_distance, options.least_area) {}

  // Forgets the layer before.
  void begin();

  // Starts an arc at an event point and returns its number.
  //
  // key      its y where the order right of the event point holds
  // segment  left end of the chain's segment there
  // side     +1 solid above, -1 below
  std::uint32_t start_arc(Vec2 point, double key, const Vec2* segment,
                          std::int8_t side);
  // Ends it; key and segment where the order left of the event point holds.
  void end_arc(std::uint32_t arc, Vec2 point, double key, const Vec2* segment);

  // Adds a loop that nothing else comes near. side: +1 solid inside.
  void add_loop(std::span<const Vec2> lower, std::span<const Vec2> upper,
                std::int8_t side);

  bool has_ends() const { return !ends_.empty(); }
  // Whether an end at this event point is so near to y as to be one with it.
  bool has_end_near(double y);

  // Links the ends of one event point.
  void link_ends();

  // Replaces `contours` by the loops of the layer.
  void write_loops(Contours& contours);

  // Whether the layer's boundary changed over between tied chains that are not
  // the same up to rounding.
  bool has_jumps() const { return has_jumps_; }
  // Notes that boundary passed other boundary by less than a tie.
  void note_jump() { has_jumps_ = true; }

  // Ends that found no partner, since construction: always 0.
  std::uint64_t unlinked_ends() const { return unlinked_ends_; }

 private:
  static constexpr std::uint32_t kNoArc = 0xffffffff;
  static constexpr std::uint32_t kNoPlace = 0xffffffff;

  struct BoundaryArc {
    Vec2 left;
    Vec2 right;
    const Vec2* vertices_begin = nullptr;
    const Vec2* vertices_end = nullptr;
    std::uint32_t next = kNoArc;  // the walk goes on there
    std::uint32_t previous = kNoArc;
    std::int8_t side = 1;
    bool is_walked = false;
  };
  struct ArcEnd {
    double key = 0;
    Vec2 point;
    const Vec2* segment = nullptr;
    std::uint32_t arc = 0;
    bool is_head = false;  // the walk along the arc ends here
    bool is_left = false;  // of the event point
  };
  // An end in a place where others lie too.
  struct Visit {
    std::uint32_t arc = 0;
    bool is_head = false;
    std::uint32_t place = 0;
  };

  bool is_lower(const ArcEnd& a, const ArcEnd& b) const;
  void sort_ends();
  void take_end(const ArcEnd& end);
  void link(const ArcEnd& a, const ArcEnd& b);
  void add_point(const Vec2& point, std::uint32_t arc);
  void exchange_partners(std::uint32_t a, std::uint32_t b);
  std::uint32_t arc_before(const ArcEnd& end) const;
  void list_visits();
  void split_loops();
  void walk(std::uint32_t start);

  const double tie_distance_;
  LoopPen pen_;
  bool has_jumps_ = false;
  std::vector<BoundaryArc> arcs_;
  std::vector<ArcEnd> ends_;
  std::multiset<double> keys_;   // of the first ends, where they are many
  std::vector<ArcEnd> waiting_;  // without partner, the lowest first
  // At the present event point: whether two pairs met in a point, whether a
  // pair was linked, the upper end of the last one, and the lower end of the
  // link that the upper end is in.
  bool has_pinches_ = false;
  bool has_linked_ = false;
  ArcEnd linked_lower_;
  ArcEnd linked_upper_;
  std::vector<std::uint32_t> added_points_;
  std::vector<Visit> visits_;
  std::uint32_t place_count_ = 0;
  std::uint64_t unlinked_ends_ = 0;
};

}  // namespace lamina::plane
