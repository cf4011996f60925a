#pragma once
// How a part is like itself, seen from above: mirrored, or turned by a part of
// a full turn, all of its layers at once. A support that stands somewhere then
// stands as well in each place that looks the same.

#include <span>
#include <vector>

#include <glm/mat3x2.hpp>

#include "base/vec.h"
#include "slicer/supports/detail/marked_places.h"

namespace lamina::slicer::detail {

// A turn or a reflection of the plane, and a shift: place ↦ m · (place, 1).
using Isometry = glm::dmat3x2;

inline Vec2 moved(const Isometry& by, Vec2 place) {
  return by * Vec3(place, 1);
}
// Heights stay.
inline Vec3 moved(const Isometry& by, Vec3 place) {
  return {moved(by, Vec2(place)), place.z};
}
inline Vec3 turned(const Isometry& by, Vec3 direction) {
  return {by * Vec3(direction.x, direction.y, 0), direction.z};
}

// The isometries that lay the part on itself, but for some hundredths of a mm:
// a group, the identity first. Some places of some layers are asked, so that
// what they say is to be tried before it is relied on. Of a solid of revolution
// the group is that of the square.
//
// marked  what is to be laid on itself, too
std::vector<Isometry> find_symmetries(const LayerSolids& solids,
                                      std::span<const MarkedPlaces> marked);

}  // namespace lamina::slicer::detail
