#pragma once
// Meshes and drawings in the place of a design: `lamina ring.stl` slices what
// `import("ring.stl");` makes.

#include <string>

namespace lamina::compiler {

// By its name: what import() reads and is no design and no file of layers, in
// any letter case. (A .3mf may hold either; import() takes its mesh.)
bool is_imported(const std::string& path);

// The text of a design that imports the file beside it.
std::string import_of(const std::string& path);

}  // namespace lamina::compiler
