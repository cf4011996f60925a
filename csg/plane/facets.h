#pragma once
// How round things become polygons: $fn, $fa, $fs, $fe.
//
// The rules are OpenSCAD's, of 2021.01 or of 2026, so that a design has the
// same vertices here and there.

#include <memory>
#include <vector>

#include "base/vec.h"
#include "csg/tree.h"

namespace lamina::planar {

// Number of sides of a circle of radius r [mm], 3 to csg::kMostFragments, or of
// the part of one that spans an angle in (0, 360], 1 at least.
int fragment_count(double r, const csg::Facets& facets, Language language,
                   double angle_deg = 360);

// Number of chords of a curve in a text of this size: fewer than of a circle,
// as the curves of letters are short.
int curve_segment_count(double size, const csg::Facets& facets,
                        Language language);

// (cos, sin) of 360° · i / n, counter-clockwise from +x.
std::vector<Vec2> unit_circle(int n);

// Number of slices of a linear_extrude that names none.
//
// max_radius  greatest distance of a vertex of the outline from the axis [mm]
// max_shift   greatest distance that a vertex moves in x, y without twist [mm]
int slice_count(const csg::LinearExtrudeParams& params, double max_radius,
                double max_shift, Language language);

}  // namespace lamina::planar
