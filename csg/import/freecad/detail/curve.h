#pragma once
// Curves of sketches, as chords.
//
// Sketches are lines and arcs of conics, and B-splines. A circle's arc is cut
// into equal chords, which follow from the error in closed form. All others are
// halved until each part stays within the error of its chord, which is looked
// at in three places of the part.

#include <optional>
#include <vector>

#include <pugixml.hpp>

#include "base/vec.h"

namespace lamina::csg::freecad {

// Ends are equal, bit by bit, where the curve is closed.
using Polyline = std::vector<Vec2>;

// The chords of a <Geometry> of a sketch, in the sketch's plane. Corners lie on
// the curve, and chords at most `error` [mm] off it.
//
// returns  nothing for a kind of curve that is not known
// throws   FormatError; LimitExceeded
std::optional<Polyline> read_curve(const pugi::xml_node& geometry,
                                   double error);

// The arc of a circle around the origin, counter-clockwise [radians].
Polyline arc(double radius, double begin, double end, double error);

// The same of an ellipse with these half axes along x and y.
Polyline elliptic_arc(Vec2 radii, double begin, double end, double error);

// Chords for a full circle of this radius, 8 at least.
int circle_chords(double radius, double error);

}  // namespace lamina::csg::freecad
