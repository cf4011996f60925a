#pragma once
// polyhedron(): faces as the user wrote them become a closed mesh.

#include <vector>

#include "csg/scene.h"
#include "csg/tree.h"
#include "parser/diagnostic.h"

namespace lamina::csg {

// Faces are clockwise from outside, as OpenSCAD has them; the mesh is
// counter-clockwise. Defects are mended and reported, one warning for each
// kind, with what was done as notes.
Mesh make_polyhedron(const Polyhedron& polyhedron, SourceRange range,
                     Diagnostics& diagnostics);

}  // namespace lamina::csg
