#pragma once
// The parts that a file of several has, for `lamina parts` and `--part`.

#include <string>
#include <vector>

#include "base/file/file_access.h"

namespace lamina::compiler {

struct FilePart {
  std::string name;   // for DesignRequest::part; so is the label
  std::string label;  // what its author calls it; empty: nothing else
  std::string what;   // "Part::Box", "12 triangles"
  // FreeCAD shows it, or the plate has it.
  bool is_shown = true;
};

// Whether parts of it have names that lamina reads: a FreeCAD file or a 3MF.
bool has_parts(const std::string& path);

// The parts of such a file, in its order.
//
// throws  FileError where it cannot be read or is broken; AccessError
std::vector<FilePart> parts_of(const std::string& path,
                               const FileAccess& access);

}  // namespace lamina::compiler
