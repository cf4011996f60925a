#pragma once
// A scene in another place or in another scene, and what turns are made of.

#include <cstdint>

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

// Adds the program of a scene, moved, as an operand of an operator of another
// one. Boxes of the other one stay. Returns the operand's root in that program,
// which is not a minuend.
//
// parent  the operator
// leaves  where the leaves of `part` begin among those of `scene`
std::uint32_t add_operand(const Scene& part, const Affine& motion,
                          std::uint32_t parent, std::uint32_t leaves,
                          Scene& scene);

}  // namespace lamina::csg
