#pragma once
// Sine and cosine of angles in degrees, and the angle of a direction.
//
// OpenSCAD's angles are degrees, and designs lean on sin(30) being 1/2 and
// cos(90) being 0. The angle is folded into [0, 45] first, so those values are
// exact and every symmetric pair of angles gives equal bits; vertices that
// should coincide do.

namespace lamina::csg {

// NaN for infinite and for huge angles, whose fraction of a turn is lost.
double sin_deg(double angle_deg);
double cos_deg(double angle_deg);

// In [-180, 180]; a whole number where it is one up to rounding.
double atan2_deg(double y, double x);

}  // namespace lamina::csg
