#pragma once
// AMF, plain and zipped. As OpenSCAD 2021.01 has it: every object counts where
// it lies; units, constellations, colours and curved triangles do not.

#include <string>
#include <string_view>
#include <vector>

#include "csg/import/raw_mesh.h"

namespace lamina::csg {

// One body for each object.
//
// name  of the file, without folder: the entry of that name in an archive is
//       the model, or else the only one
//
// throws  FormatError
std::vector<RawMesh> parse_amf(std::string_view bytes, const std::string& name);

}  // namespace lamina::csg
