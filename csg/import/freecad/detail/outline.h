#pragma once
// Closed outlines from the curves of a sketch.
//
// A sketch lists its curves in any order and direction. FreeCAD joins them to
// wires and nests these: what lies in an odd number of wires is filled. That
// does not depend on how wires are parted where several meet in a point, so
// curves are joined as they come.
//
// Wires that cross each other are faces of their own there, and overlap: the
// solids over them are one. Here their outlines are united first.

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
  bool had_crossings = false;      // wires that crossed are united
};

// The outline of a sketch of lines and arcs of circles.
//
// corners  counts those that were cut for all outlines of a file, also for what
//          turns out to be none; more than plane::kMostCorners throw
// why      gets the reason where there is none
// returns  nothing where the object is not such a sketch, or not closed
std::optional<Outline> read_outline(const Object& sketch, double error,
                                    std::size_t& corners, std::string& why);

// Puts, for contours that cross, the outline of all that they enclose. What
// contours have in common counts as a crossing where it is wider than `error`
// [mm]: arcs that touch cross by less, once they are chords.
//
// returns  whether there were any
bool unite_crossing(double error, std::vector<Polyline>& contours);

// Joins curves at their ends. Nothing where an end meets no other.
std::optional<std::vector<Polyline>> join_curves(std::vector<Polyline> curves);

}  // namespace lamina::csg::freecad
