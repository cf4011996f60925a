#pragma once
// From pieces of chains to loops.
//
// Where a chain survives the Boolean between two stops, that piece of it is
// boundary. A piece has its solid on one side and is walked with the solid on
// the left: to the right where the solid is above, to the left where it is
// below. At a stop pieces end and begin: their ends, sorted by y and joined
// two by two, are the symmetric difference of the solid intervals left and
// right of the stop, hence the vertical boundary. Each pair has one end that
// arrives and one that departs (I4), so links close to loops whatever the
// rounding did; rounding can only move a point.
//
// Where two pairs meet in a point and belong to one loop, that loop would
// touch itself; exchanging their partners makes it two loops. So regions that
// touch in a point have loops of their own.

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "ldni/section/contours.h"
#include "ldni/sweep/detail/loop_pen.h"

namespace lamina::ldni::detail {

// How far [tie distances] a change between tied chains may reach: groups of
// ties can be a few ties wide.
constexpr double kMostJump = 4;

class ContourTracer {
 public:
  // tie_distance    ends of one side of a stop nearer than this could tie [mm]
  // merge_distance  as of LoopPen
  ContourTracer(double tie_distance, double merge_distance)
      : tie_distance_(tie_distance), pen_(merge_distance) {}

  // Forgets the layer before.
  void begin();

  // Starts a piece at a stop and returns its number.
  //
  // key        its y where the order right of the stop holds
  // segment    left end of the chain's segment there
  // direction  +1 solid above, -1 below
  std::uint32_t start_piece(Vec2 point, double key, const Vec2* segment,
                            std::int8_t direction);
  // Ends it; key and segment where the order left of the stop holds.
  void end_piece(std::uint32_t piece, Vec2 point, double key,
                 const Vec2* segment);

  // Adds a loop that nothing else comes near. direction: +1 solid inside.
  void add_loop(std::span<const Vec2> lower, std::span<const Vec2> upper,
                std::int8_t direction);

  bool has_ends() const { return !ends_.empty(); }
  // Whether an end of this stop is as near to y as makes no difference.
  bool has_end_near(double y) const;

  // Links the ends of one stop.
  void link_stop();

  // Replaces `contours` by the loops of the layer.
  void trace(Contours& contours);

  // Whether the layer's boundary changed over between tied chains that are not
  // the same up to rounding.
  bool has_jumps() const { return has_jumps_; }
  // Notes that boundary passed other boundary by less than a tie.
  void note_jump() { has_jumps_ = true; }

  // Ends that found no partner, since construction: always 0.
  std::uint64_t unlinked_ends() const { return unlinked_ends_; }

 private:
  static constexpr std::uint32_t kNoPiece = 0xffffffff;

  struct Piece {
    Vec2 left;
    Vec2 right;
    const Vec2* vertices_begin = nullptr;
    const Vec2* vertices_end = nullptr;
    std::uint32_t next = kNoPiece;  // the walk goes on there
    std::uint32_t previous = kNoPiece;
    std::uint32_t loop = kNoPiece;
    std::int8_t direction = 1;
  };
  struct End {
    double key = 0;
    Vec2 point;
    const Vec2* segment = nullptr;
    std::uint32_t piece = 0;
    bool arrives = false;
    bool is_left = false;  // of the stop
  };
  // Ends of two linked pairs that meet in a point.
  struct Pinch {
    End first;
    End second;
  };

  bool is_lower(const End& a, const End& b) const;
  void sort_ends();
  void take_end(const End& end);
  void link(const End& a, const End& b);
  std::uint32_t arriving_piece(const End& end) const;
  void number_loops();
  void number_loop(std::uint32_t piece, std::uint32_t loop);
  void split_pinches();
  void walk(std::uint32_t start);

  const double tie_distance_;
  LoopPen pen_;
  bool has_jumps_ = false;
  std::vector<Piece> pieces_;
  std::vector<End> ends_;
  std::vector<End> waiting_;  // without partner, the lowest first
  std::vector<End> linked_;   // upper ends of the pairs of the stop
  std::vector<Pinch> pinches_;
  std::uint32_t loop_count_ = 0;
  std::uint64_t unlinked_ends_ = 0;
};

}  // namespace lamina::ldni::detail
