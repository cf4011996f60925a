#pragma once
// import() of FreeCAD files, which becomes nodes when it is evaluated.

#include <optional>
#include <string>
#include <string_view>

#include "csg/eval/builtin/modules.h"

namespace lamina::csg {

// Adds a group of what the file shows, or of one object of it. Warns of what is
// left out, and fails where the file is broken or lacks the object.
//
// path  of the file; empty: none
// part  the object's name or label
void import_freecad(const std::string& path,
                    const std::optional<std::string>& part,
                    const ModuleCall& call);

}  // namespace lamina::csg
