#pragma once
// The area of a layer as trapezoids with level sides, which OpenGL can fill.
//
// A line sweeps up the layer. Between two corners of different heights it meets
// the same edges in the same order; pairs of them enclose the solid. A
// trapezoid lasts as long as its pair, so that there are about as many as there
// are corners.

#include <vector>

#include "plane/contours.h"

namespace lamina::slicer {

struct Trapezoid {
  double bottom;
  double top;
  double bottom_left;  // x at the bottom
  double bottom_right;
  double top_left;
  double top_right;
};

// contours  simple and disjoint
void cut_into_trapezoids(const plane::Contours& contours,
                         std::vector<Trapezoid>& trapezoids);

}  // namespace lamina::slicer
