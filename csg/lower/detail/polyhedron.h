#pragma once
// polyhedron(): faces as the user wrote them become a closed mesh.

#include "base/diagnostic.h"
#include "csg/scene.h"
#include "csg/tree.h"

namespace lamina::csg {

// Faces are clockwise from outside, as OpenSCAD has them; the mesh is
// counter-clockwise. Defects are repaired and reported, one warning for each
// kind, with what was done as notes.
Mesh make_polyhedron(const PolyhedronParams& polyhedron, SourceRange range,
                     Diagnostics& diagnostics);

// Whether every ray from the mean of the mesh's vertices leaves the solid once,
// as of every convex solid: then it cannot overlap itself. The mesh is closed;
// turned inside out it is not star-shaped.
bool is_star_shaped(const Mesh& mesh);

// The corners of the faces alone, each as a triangle of no area. Faults of the
// faces do not matter.
Mesh make_corners(const PolyhedronParams& polyhedron, SourceRange range,
                  Diagnostics& diagnostics);

}  // namespace lamina::csg
