#pragma once
// import() of STEP, IGES and BREP, and of the boundaries in FreeCAD files.

#include <vector>

#include "base/diagnostic.h"
#include "base/file/file_access.h"
#include "csg/cad/cad_reader.h"
#include "csg/import/mesh_file.h"
#include "csg/tree.h"

namespace lamina::csg {

// Reads the solids of a file, and reports at `range` what the reader warns of.
//
// chordal_error  in the file's coordinates [mm]
// throws         FileError, GeometryError: such a file has to be there, unlike
//                a mesh, which a design is made without, as in OpenSCAD
std::vector<RawMesh> read_cad_file(const ImportParams& params,
                                   double chordal_error, cad::Reader& reader,
                                   const FileAccess& access, SourceRange range,
                                   Diagnostics& diagnostics);

}  // namespace lamina::csg
