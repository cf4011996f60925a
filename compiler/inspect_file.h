#pragma once
// Inspects a file of layers: here readers and checks meet.

#include <string>
#include <vector>

#include "base/file/file_access.h"
#include "csg/mesh/mesh_facts.h"
#include "slicer/check/defects/inspect.h"

namespace lamina::compiler {

// Reads the file layer by layer. Throws FileError where it is no file of layers
// (layer_reader.h) or breaks off.
slicer::Inspection inspect_file(const std::string& path,
                                const slicer::InspectOptions& options,
                                const FileAccess& access);

// The meshes of a file that is imported as a design, as they are in the file;
// none of another.
std::vector<csg::MeshFacts> inspect_meshes(const std::string& path,
                                           const FileAccess& access);

}  // namespace lamina::compiler
