#pragma once
// 3MF. As OpenSCAD 2021.01 has it: every mesh object counts where it lies;
// units, build items, components and colours do not.

#include <string_view>
#include <vector>

#include "csg/import/raw_mesh.h"

namespace lamina::csg {

// One body for each mesh object.
//
// throws  FormatError
std::vector<RawMesh> parse_3mf(std::string_view bytes);

}  // namespace lamina::csg
