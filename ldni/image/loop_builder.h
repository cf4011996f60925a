#pragma once
// Loops from the intervals of neighbouring rays: the contours of the paper.
//
// Zeng et al. 2011, section 5: every ray has an even number of samples (rule
// 1); a sample links to the nearest one of the same type on each neighbouring
// ray if no other sample lies between (rule 2); a sample without such a
// partner is a turning point and links to its neighbour on its own ray (rule
// 3). Algorithm 1.1 walks the links.
//
// Seen from the gap between two rays, rules 2 and 3 are one: sort the samples
// of both rays together; the stretches where exactly one of the two rays is in
// the solid are bounded by pairs of samples, and each pair is a link. Within a
// pair the samples are of one type on different rays (rule 2) or of two types
// on one ray (rule 3), and every sample is in exactly one pair on either side.
// So all loops close, whatever the samples are, and none crosses another.
//
// Limits of the method, which `--contour faithful` does not have: corners are
// cut off between two rays; caps stop at the last ray that meets them; what is
// thinner than the pitch in x meets one ray at most and leaves no loop; a wall
// so oblique that its intervals on two neighbouring rays do not overlap falls
// apart.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ldni/image/ray_grid.h"
#include "ldni/image/sample.h"
#include "plane/contours.h"

namespace lamina::ldni {

// One object per thread: it owns scratch that layers share.
class LoopBuilder {
 public:
  // Replaces `contours` by the loops of one layer: outer ones counter-
  // clockwise, holes clockwise, in the order of their first samples. Points
  // within kCollinearDistance of the line through their neighbours are left
  // out: a wall parallel to x would have one for every ray.
  //
  // intervals  of all rays of `rays`
  void build(const RayGrid& rays, const LayerIntervals& intervals,
             plane::Contours& contours);

 private:
  void link_gap(const LayerIntervals& intervals, std::size_t gap);
  void walk_links(const RayGrid& rays, const LayerIntervals& intervals,
                  plane::Contours& contours);

  // The link from each sample to the next of its loop; sample 2i enters
  // interval i, sample 2i+1 leaves it.
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> ray_of_interval_;
};

}  // namespace lamina::ldni
