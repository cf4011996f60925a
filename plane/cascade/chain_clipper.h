#pragma once
// Clips the chains of a layer to the boxes in which their leaves matter.
//
// Drills that stick out, halves of space made of cubes "big enough", bars that
// an intersection cuts to length: leaves of strangers' designs often reach far
// beyond their active zone (active_zones.h), and cross each other there, where
// nobody will ever see it. A leaf's section R may be replaced by any R' with
//
//   R' = R    in the zone, and
//   R' empty  outside of the box of R:
//
// outside of the zone some operator above fails with R and with R', since
// operators hold only in their boxes as long as leaves stay in theirs (by
// induction from the leaves up). So the result is the same everywhere.
//
// R' is R within a rectangle around the zone. Beyond the left and right side a
// chain is dropped, so that chains end there in pairs, at one x exactly, as if
// a vertical edge closed them (I1, ray_sweep.h). A part of a chain beyond the
// upper or lower side is replaced by the straight line between its ends, which
// lies beyond that side too, so the winding number within is what it was. What
// whole chains of a leaf then have in common with a side is replaced by their
// sum, which is mostly nothing.
//
// Sides bring no boundary, since the value of the program does not depend on
// the leaf there. They keep a distance from the zone that ties do not bridge,
// so chains tie there with what they tied with before; and they lie where no
// designer puts a face. Points of the result are those of chains as they were,
// but for the rounding of an edge that was cut (2e-12 mm at 1e4 mm).
//
// The rectangle grows in steps with the zone, so that upright walls stay the
// same chains through many layers (Cascade::Group::keep).

#include <cstdint>
#include <span>
#include <vector>

#include "plane/cascade/active_zones.h"
#include "plane/cascade/leaf_parts.h"
#include "plane/chains.h"
#include "plane/program/boolean_program.h"

namespace lamina::plane {

class ChainClipper {
 public:
  // The program must outlive the object.
  explicit ChainClipper(const BooleanProgram& program) : program_(program) {}

  // Takes up a layer, whose chains are those of the program's operands and must
  // outlive the calls of clip(). Finds the rectangles: O(its points).
  void begin(const LayerChains& layer);

  // The share of the layer's chains, as they go along x, that lies within the
  // rectangles, as if each filled its leaf's box evenly: 0 to 1.
  double share_within() const { return share_within_; }

  // The layer's chains, clipped. Loops within their rectangle stay as they are;
  // all others of a leaf become one, which need not be connected unless it has
  // two chains. Valid until the next call.
  LayerChains clip();

 private:
  struct Section : LeafPart {
    Box2 rectangle;  // to be clipped to
  };
  // Chains along the lower or upper side, `winding` of them.
  struct SideChain {
    double low = 0;  // x
    double high = 0;
    std::int32_t winding = 0;
  };
  struct SideEnd {
    double x = 0;
    std::int32_t change = 0;  // of the winding number above the side
  };

  void clip_section(const Section& section);
  bool cut_chain(std::span<const Vec2> chain, const Box2& rectangle);
  void straighten_beyond(double limit, double direction);
  void add_chain(std::span<const Vec2> points, const Chain& like);
  void add_chains(std::span<const Chain> chains);
  void add_side(std::span<const SideChain> side, double y,
                std::uint32_t operand);

  const BooleanProgram& program_;
  std::vector<Section> sections_;
  double share_within_ = 1;

  // The present chain, and work space for it.
  std::vector<Vec2> run_;
  std::vector<Vec2> straightened_;
  // The sides of the present leaf, and work space.
  std::vector<SideChain> lower_side_;
  std::vector<SideChain> upper_side_;
  std::vector<SideEnd> side_ends_;
  std::vector<SideChain> sum_;

  // The present layer and what was made of it.
  std::span<const Vec2> old_points_;
  std::vector<Vec2> points_;
  std::vector<Chain> chains_;
  std::vector<ChainLoop> loops_;
};

}  // namespace lamina::plane
