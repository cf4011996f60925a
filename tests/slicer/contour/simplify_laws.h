#pragma once
// What simplified contours owe to those they came from.

#include <string>

#include "plane/contours.h"

namespace lamina::slicer {

plane::Contours simplified(plane::Contours contours, double tolerance);

// Simplifies sound contours and expects all laws to hold: either contour
// within the tolerance of the other, loops as many, as simple and as disjoint,
// turned and nested as before, on doubles and, exactly, on the 32-bit numbers
// of a file.
void expect_lawful(const plane::Contours& before, double tolerance,
                   const std::string& what);

}  // namespace lamina::slicer
