#pragma once
// Where drains go through the wall of a cavity.

#include <cstddef>
#include <span>
#include <vector>

#include "base/vec.h"
#include "slicer/contour/layer_solids.h"
#include "slicer/hollow/detail/cavities.h"
#include "slicer/hollow/hollow.h"

namespace lamina::slicer::detail {

// A low drain and a high one, both level: the low one where the wall is
// thinnest at its height, the high one as far from it as the wall is about as
// thin.
//
// part  the solid, in the layers that the cavity's indices mean
std::vector<Drain> choose_drains(const Cavity& cavity, const LayerSolids& part,
                                 double diameter);

// The nearest point of a cavity.
struct NearestCavity {
  std::size_t cavity = 0;  // index
  Vec3 point = Vec3(0);
  double distance = 0;  // [mm]
};
NearestCavity find_nearest(Vec3 place, std::span<const Cavity> cavities,
                           const LayerSolids& part);

// From the place straight to a point of a cavity.
Drain drain_from(const DrainPlace& place, Vec3 point);

}  // namespace lamina::slicer::detail
