#pragma once
// How deep a place lies in a layer: the distance from its contours, up to a
// reach.
//
// Edges are kept in rows of their heights. The nearest one is searched in the
// row of the place first and then in those beside it, as far as they could hold
// a nearer one; the edges of its own row decide whether the place is inside.

#include <cstddef>
#include <span>

#include "base/vec.h"
#include "plane/cell_grid.h"
#include "plane/contours.h"

namespace lamina::slicer {

class LayerDistance {
 public:
  struct Depth {
    double depth = 0;  // more than 0 inside; -reach … reach [mm]
    // Where depth grows: a unit vector, or 0 out of reach.
    Vec2 inward = Vec2(0);
  };

  // reach  the greatest distance that is of interest [mm]
  LayerDistance(const plane::Contours& contours, double reach);

  Depth at(Vec2 place) const;

 private:
  struct Edge {
    Vec2 from;
    Vec2 to;
  };

  int row_of(double y) const;
  std::span<const Edge> edges_of(int row) const {
    return edges_[static_cast<std::size_t>(row)];
  }
  bool is_inside(Vec2 place) const;

  double reach_;
  double low_ = 0;
  double row_height_ = 1;
  int row_count_ = 0;      // 0: nothing is drawn
  CellLists<Edge> edges_;  // row by row; some in several
};

}  // namespace lamina::slicer
