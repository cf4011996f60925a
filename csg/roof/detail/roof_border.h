#pragma once
// The border of what an outline, moving inwards, has left of a region, to find
// the parts of the outline that still bound it.

#include <vector>

#include "csg/mesh/box_tree.h"
#include "csg/roof/detail/tracks.h"
#include "plane/region/region.h"

namespace lamina::csg {

// A part of an edge, from one share of it to another one.
struct Part {
  double from = 1;
  double to = 0;

  bool is_empty() const { return !(from < to); }
};

class RoofBorder {
 public:
  explicit RoofBorder(const plane::Region& region);

  // Returns the part of the front, an edge that has moved, that is within
  // `reach` [mm] of the border, or a little more.
  Part near_part(const Edge& front, double reach) const;

 private:
  std::vector<Edge> edges_;
  BoxTree tree_;
};

}  // namespace lamina::csg
