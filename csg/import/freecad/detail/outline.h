#pragma once
// Closed outlines from the curves of a sketch.
//
// A sketch lists its curves in any order and direction. FreeCAD joins them to
// wires and nests these: what lies in an odd number of wires is filled. That
// does not depend on how wires are parted where several meet in a point, so
// curves are joined as they come.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "csg/import/freecad/detail/curve.h"
#include "csg/import/freecad/detail/document.h"

namespace lamina::csg::freecad {

// Filled where an odd number of the contours surround a point.
struct Outline {
  Mat4 plane = Mat4(1);  // from the outline's plane z = 0 to what holds it
  std::vector<Polyline> contours;  // closed, the first corner not repeated
};

// The outline of a sketch of lines and arcs of circles.
//
// corners  counts those that were cut for all outlines of a file, also for what
//          turns out to be none; more than plane::kMostCorners throw
// why      gets the reason where there is none
// returns  nothing where the object is not such a sketch, or not closed
std::optional<Outline> read_outline(const Object& sketch, double error,
                                    std::size_t& corners, std::string& why);

// Joins curves at their ends. Nothing where an end meets no other.
std::optional<std::vector<Polyline>> join_curves(std::vector<Polyline> curves);

}  // namespace lamina::csg::freecad
