#pragma once
// How many facets stand for what is round.
//
// $fn decides where it is given. Else $fa and $fs do, by OpenSCAD's rules, or,
// where a chordal error is asked for, it does: as few facets as keep their
// distance from the surface that they stand for, measured in the plane across
// the curve, within it. Throws LimitExceeded where these are too many.

#include "base/vec.h"
#include "csg/lower/detail/extrude.h"
#include "csg/tree.h"

namespace lamina::csg {

struct Fineness {
  Facets facets = {};
  Language language = Language::k2021;
  double chordal_error = 0;  // in the node's own coordinates [mm]; 0: none

  bool is_by_error() const { return chordal_error > 0 && !(facets.fn > 0); }
};

// Returns the number of sides of a circle's polygon.
int circle_fragments(double r, const Fineness& fineness);

// Returns the number of sides of a sphere's rings; rings are half as many,
// rounded up, the first one half a step from the pole.
int sphere_fragments(double r, const Fineness& fineness);

// Returns the number of facets of a rotate_extrude over its whole angle.
int turn_fragments(const ProfileRange& range, double angle_deg,
                   const Fineness& fineness);

// Returns the greatest angle of a side of an arc of radius r that a roof draws:
// unlike in circles, both $fa and $fs bound it [degrees].
double arc_step_deg(double r, const Fineness& fineness);

// Steps of an extrusion whose sides are not planar.
struct ExtrusionSteps {
  int slices = 1;
  double longest_edge = 0;  // of the outline; 0: edges stay whole [mm]
};

// max_radius  greatest distance of a point of the outline from the axis [mm]
// max_shift   greatest distance that one moves in x, y without twist [mm]
ExtrusionSteps extrusion_steps(const LinearExtrudeParams& params,
                               double max_radius, double max_shift,
                               const Fineness& fineness);

// Returns the greatest factor by which the map lengthens a vector, or a little
// more where its columns are not perpendicular, up to 1e-12 of itself. Maps
// that differ by rounding have the same.
double greatest_stretch(const Affine& map);

}  // namespace lamina::csg
