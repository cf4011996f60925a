#pragma once
// The regions of a layer: its outer loops, each with the holes in it.

#include <vector>

#include "ldni/section/contours.h"

namespace lamina::slicer {

// The area of each outer loop less its holes [mm²], in the order of the outer
// loops.
//
// contours  disjoint loops, outer ones counter-clockwise, holes clockwise
std::vector<double> areas_of_regions(const ldni::Contours& contours);

}  // namespace lamina::slicer
