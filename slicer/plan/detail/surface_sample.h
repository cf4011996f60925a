#pragma once
// The surface of a solid, with a bound on what it costs to look at.
//
// Which faces of leaves are boundary is settled by boxes for many, and by a
// plane problem for each of the others (csg/boundary/boundary_faces.h). Plane
// problems would cost many times a slicing, and sums over the surface do not
// need all of them. The largest open faces are solved, and of the small ones a
// sample, each with a probability proportional to its area, so that sums over
// the sample have no bias and all faces of it stand for the same area.
// Source: systematic sampling with probabilities proportional to size, Madow,
// On the theory of systematic sampling II, Annals of Mathematical Statistics 20
// (1949).

#include <cstddef>
#include <vector>

#include "base/vec.h"
#include "csg/scene.h"
#include "plane/tie_distance.h"

namespace lamina::slicer {

// Lengths [mm], and sums as a share of the whole surface, that differ by less
// are equal: so far the rounding of Booleans may move them.
inline constexpr double kSameLength = kTieDistance;

// A plane part of the surface.
struct SurfacePart {
  Vec3 normal;      // unit length, out of the solid
  double area = 0;  // of the surface that it stands for [mm²]
  Box3 box;
};

struct SurfaceSample {
  std::vector<SurfacePart> parts;
  Box3 box;  // of the whole surface, up to kSameLength; empty without one
  double area = 0;  // of the whole surface [mm²]
  // Sums of areas are off by more in one of twenty cases; 0 where all faces
  // were solved.
  double doubt = 0;
};

// most_edges  of plane problems: about as many are cut, but for a few faces
// that
//             say how far the surface reaches
SurfaceSample sample_surface(const csg::Scene& scene, std::size_t most_edges);

}  // namespace lamina::slicer
