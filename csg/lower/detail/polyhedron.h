#pragma once
// polyhedron(): faces as the user wrote them become a closed mesh.

#include <vector>

#include "base/diagnostic.h"
#include "csg/scene.h"
#include "csg/tree.h"

namespace lamina::csg {

// Faces are clockwise from outside, as OpenSCAD has them; the mesh is
// counter-clockwise. Defects are repaired and reported, one warning for each
// kind, with what was done as notes.
Mesh make_polyhedron(const PolyhedronParams& polyhedron, SourceRange range,
                     Diagnostics& diagnostics);

// For those who look at the corners of the faces only, a triangle of no area
// for each. What is wrong with the faces does not matter.
Mesh make_corners(const PolyhedronParams& polyhedron, SourceRange range,
                  Diagnostics& diagnostics);

}  // namespace lamina::csg
