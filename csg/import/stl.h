#pragma once
// STL, as text and as binary.
//
// A file is binary where its size is the one that its number of facets asks
// for, whatever it begins with: many programs begin binary files with "solid".
// Of text, lines with "vertex" count and all else is passed over, as OpenSCAD
// 2021.01 does; so are files of neither kind, which have no facets.

#include <string_view>

#include "csg/import/raw_mesh.h"

namespace lamina::csg {

// throws  FormatError for a vertex without three numbers, and for a fourth
//         vertex in a loop; for what is neither text nor as long as its
//         facets need
RawMesh parse_stl(std::string_view bytes);

}  // namespace lamina::csg
