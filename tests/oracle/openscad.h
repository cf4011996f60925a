#pragma once
// OpenSCAD as a judge: renders a design to a mesh.

#include <filesystem>

#include "csg/scene.h"

namespace lamina::oracle {

// Returns the mesh that `openscad` makes of `design`; corners that agree are
// joined. The design may not read other files, for the mesh is kept.
//
// throws  std::runtime_error where the program is missing or fails
csg::Mesh render_with_openscad(const std::filesystem::path& design);

// Reads a binary STL file.
csg::Mesh read_binary_stl(const std::filesystem::path& path);

// Distance of float32 numbers at the largest coordinate [mm].
double float32_spacing(const csg::Mesh& mesh);

}  // namespace lamina::oracle
