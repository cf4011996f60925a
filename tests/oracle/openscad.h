#pragma once
// OpenSCAD as a judge: renders a design to a mesh.

#include <filesystem>

#include "csg/scene.h"

namespace lamina::oracle {

// The mesh that `openscad` makes of `design`, corners that agree joined. Kept
// in `cache` under the design's text and the program's version: rendering takes
// seconds. The design may not read other files.
//
// throws  std::runtime_error where the program is missing or fails
csg::Mesh render_with_openscad(const std::filesystem::path& design,
                               const std::filesystem::path& cache);

// Reads a binary STL file.
csg::Mesh read_binary_stl(const std::filesystem::path& path);

// Distance of float32 numbers at the largest coordinate [mm].
double float32_spacing(const csg::Mesh& mesh);

}  // namespace lamina::oracle
