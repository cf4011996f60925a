#pragma once
// From a solid to a mesh that keeps its chordal error.
//
// BRepMesh cuts edges into chords and faces into triangles. What it makes is
// measured against the curves and surfaces themselves. Where chords are too far
// from their edges the solid is meshed again, twice as finely; triangles that
// are too far from their face are split (detail/face_mesh.h).
//
// A triangulation belongs to one face. But faces share their edges, and an edge
// has the same points for both: vertices are joined by the edge that they lie
// on, not by where they lie. So the mesh is closed where the solid is.

#include <string>
#include <vector>

#include "csg/cad/detail/solids.h"
#include "csg/scene.h"

namespace lamina::cad {

// BRepMesh takes points this near for one [mm], and no less for a deflection.
constexpr double kLeastChordalError = 1e-7;

// There are more than csg/limits.h allows.
struct TooManyTriangles {
  double triangles;
};

// warnings  gets a deviation that stays too large, and faces without triangles
csg::Mesh tessellate(const Solid& solid, const Fineness& fineness,
                     std::vector<std::string>& warnings);

}  // namespace lamina::cad
