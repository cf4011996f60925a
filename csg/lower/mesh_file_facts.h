#pragma once
// Measures the meshes of a file as they are, before import() repairs them.

#include <string>
#include <vector>

#include "base/file/file_access.h"
#include "csg/mesh/mesh_facts.h"

namespace lamina::csg {

// Bodies of a file; empty for one that is not a mesh or cannot be read. Equal
// vertices are one.
std::vector<MeshFacts> measure_mesh_file(const std::string& path,
                                         const FileAccess& access);

}  // namespace lamina::csg
