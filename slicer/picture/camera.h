#pragma once
// OpenSCAD's camera: from where a part is seen.
//
// The viewer looks along +y, with +z up. The part is moved so that its center
// of attention is at the origin, then turned by z, by y and by x. The numbers,
// the defaults and the view of everything are those of openscad 2021.01, so
// that its pictures and these show the same.

#include <span>

#include "base/vec.h"

namespace lamina::slicer {

struct Camera {
  enum class Projection { kPerspective, kOrthogonal };

  Vec3 center = Vec3(0);  // where it looks; the viewport's translation
  Vec3 turn_deg = Vec3(55, 0, 25);  // the viewport's rotation
  double distance = 140;            // from the center [mm]
  double field_deg = 22.5;          // of view, from the bottom to the top
  Projection projection = Projection::kPerspective;

  // The camera of --camera: center, turn and distance (7 numbers), or eye and
  // center (6).
  static Camera from_numbers(std::span<const double> numbers);

  // Makes it look at the middle of the box.
  void center_on(const Box3& box);

  // Moves it back to where all of the box is seen, in the same direction.
  void show_all(const Box3& box);

  // Maps the world to the viewer's coordinates: right, up, towards the viewer,
  // who is at the origin.
  Mat4 view_from_world() const;

  // The picture's projection, with the box between its near and its far plane.
  //
  // aspect  width over height
  Mat4 clip_from_view(double aspect, const Box3& box) const;
};

}  // namespace lamina::slicer
