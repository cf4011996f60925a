#pragma once
// The border of what an outline, moving inwards, has left of a region, to find
// the parts of the outline that still bound it.

#include <vector>

#include "base/vec.h"
#include "csg/boundary/box_tree.h"
#include "plane/region/region.h"

namespace lamina::csg {

// A straight part of an outline that moves, at one time.
struct Front {
  Vec2 begin{0};
  Vec2 end{0};

  Vec2 at(double share) const { return begin + share * (end - begin); }
};

// From one share of a front to another one.
struct Part {
  double from = 1;
  double to = 0;

  bool is_empty() const { return !(from < to); }
};

class RoofBorder {
 public:
  explicit RoofBorder(const plane::Region& region);

  // Of the front, at least what is within `reach` [mm] of the border.
  Part near_part(const Front& front, double reach) const;

 private:
  std::vector<Front> edges_;
  BoxTree tree_;
};

}  // namespace lamina::csg
