#pragma once
// A scene in another place.

#include "csg/scene.h"

namespace lamina::csg {

// Turns the scene, then shifts it.
//
// turn  one that maps axes to axes, so that boxes stay tight and no coordinate
//       is rounded
void move_scene(Scene& scene, const Affine& turn, Vec3 shift);

// Turns the scene about the origin by any rotation; boxes are found anew.
void turn_scene(Scene& scene, const Affine& rotation);

}  // namespace lamina::csg
