#pragma once
// A scene in another place, and what turns are made of.

#include "csg/scene.h"

namespace lamina::csg {

// The inverse of a turn, without any shift: its transpose.
Affine inverse_of(const Affine& turn);

// A unit vector at a right angle to a unit vector.
Vec3 perpendicular_to(Vec3 direction);

// Turns the scene, then shifts it.
//
// turn  one that maps axes to axes, so that boxes stay tight and no coordinate
//       is rounded
void move_scene(Scene& scene, const Affine& turn, Vec3 shift);

// Turns the scene about the origin by any rotation; boxes are found anew.
void turn_scene(Scene& scene, const Affine& rotation);

}  // namespace lamina::csg
