#pragma once
// How round things become polygons: $fn, $fa, $fs, $fe.
//
// The rules are OpenSCAD's, of 2021.01 or of 2026, so that a design has the
// same vertices here and there.

#include <vector>

#include "base/vec.h"
#include "csg/tree.h"
#include "plane/region/region.h"

namespace lamina::csg {

// Number of sides of a circle of radius r [mm], 3 to kMostFragments, or of
// the part of one that spans an angle in (0, 360], 1 at least.
int fragment_count(double r, const Facets& facets, Language language,
                   double angle_deg = 360);

// Number of chords of a curve in a text of this size: fewer than of a circle,
// as the curves of letters are short.
int curve_segment_count(double size, const Facets& facets, Language language);

// (cos, sin) of 360° · i / n, counter-clockwise from +x.
std::vector<Vec2> unit_circle(int n);

// The 2D modules. Empty where a size is not positive or not finite.
plane::Region square(Vec2 size, bool center);
plane::Region circle(double r, int fragments);

// Number of slices of a linear_extrude that names none.
//
// max_radius  greatest distance of a vertex of the outline from the axis [mm]
// max_shift   greatest distance that a vertex moves in x, y without twist [mm]
int slice_count(const LinearExtrudeParams& params, double max_radius,
                double max_shift, Language language);

}  // namespace lamina::csg
