#pragma once
// A layer of two stacks in one picture: what both cover, and in colour what
// only one of them covers. Differences are often too small to be seen, so a
// second field magnifies the place of the greatest distance.

#include <array>
#include <string>

#include "plane/contours.h"
#include "slicer/check/compare/compare.h"
#include "slicer/picture/image.h"

namespace lamina::slicer {

// difference  of the two, for its words and its place
// names       of a and b
Image draw_difference(const plane::Contours& a, const plane::Contours& b,
                      const LayerDifference& difference,
                      const std::array<std::string, 2>& names);

}  // namespace lamina::slicer
