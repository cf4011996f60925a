#pragma once
// OBJ, the format of Wavefront: vertices and faces; all else (normals,
// textures, materials, lines, groups) is passed over.

#include <string_view>

#include "csg/import/raw_mesh.h"

namespace lamina::csg {

// All objects and groups together make one body. Indices count from 1, or, if
// negative, back from the last vertex so far.
//
// throws  FormatError for a vertex without three numbers and for a corner that
//         is not there
RawMesh parse_obj(std::string_view bytes);

}  // namespace lamina::csg
