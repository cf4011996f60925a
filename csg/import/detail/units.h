#pragma once
// Units of lengths of files for printers.

#include <string_view>

#include "csg/import/mesh_file.h"

namespace lamina::csg {

// Turns lengths in that unit ("inch"; empty: millimetres) into millimetres
// where the file's placing counts; else, or where there is no such unit, says
// that it was passed over.
void heed_unit(std::string_view unit, Placing placing, PlacedMeshes& meshes);

}  // namespace lamina::csg
