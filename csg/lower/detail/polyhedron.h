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

// The corners of the faces alone, each as a triangle of no area. Faults of the
// faces do not matter.
Mesh make_corners(const PolyhedronParams& polyhedron, SourceRange range,
                  Diagnostics& diagnostics);

}  // namespace lamina::csg
