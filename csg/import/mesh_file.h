#pragma once
// import() of meshes: STL, OFF, AMF, 3MF, OBJ.

#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "base/file/file_access.h"
#include "csg/import/mesh_readers.h"
#include "csg/tree.h"

namespace lamina::csg {

// Reads the bodies of a file; none where it cannot be read, which it reports in
// OpenSCAD's words at `range`. It drops facets with coordinates that are no
// numbers, with a warning, so all vertices are finite.
//
// format  one of meshes
std::vector<RawMesh> read_mesh_file(const std::string& path,
                                    ImportFormat format,
                                    const FileAccess& access, SourceRange range,
                                    Diagnostics& diagnostics);

}  // namespace lamina::csg
