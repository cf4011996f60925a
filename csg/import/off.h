#pragma once
// OFF, the format of Geomview: text, with or without normals, colours and
// texture coordinates ([ST][C][N]OFF, 4OFF), which are passed over.

#include <string_view>

#include "csg/import/raw_mesh.h"

namespace lamina::csg {

// Each vertex and each face has a line of its own.
//
// throws  FormatError where something else stands than the header promises
RawMesh parse_off(std::string_view bytes);

}  // namespace lamina::csg
