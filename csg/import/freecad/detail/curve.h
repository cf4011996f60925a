#pragma once
// Curves of sketches, as chords.
//
// Lines and arcs of circles are read of a sketch: equal chords of an arc follow
// from the error in closed form. A feature over any other curve is taken by its
// boundary.

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
// returns  nothing for any other kind of curve
// throws   FormatError; plane::LimitExceeded
std::optional<Polyline> read_curve(const pugi::xml_node& geometry,
                                   double error);

// The arc of a circle around the origin, counter-clockwise [radians].
Polyline arc(double radius, double begin, double end, double error);

// Chords for a full circle of this radius, 8 at least.
int circle_chords(double radius, double error);

}  // namespace lamina::csg::freecad
