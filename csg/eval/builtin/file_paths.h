#pragma once
// Files that modules name: where they are, and how `.csg` shows them.

#include <string>
#include <string_view>

#include "base/vec.h"
#include "csg/eval/builtin/modules.h"
#include "csg/tree.h"

namespace lamina::csg {

// The absolute path of the file that a module call names: in the folder of the
// file that holds the call or, deprecated, in the design's folder. Empty for an
// empty name. The file need not exist; the design depends on it all the same.
// Throws AccessError where it may not be read.
std::string find_file(std::string_view name, const ModuleCall& call);
// Finds the file that code of the folder `from` names at `place`.
std::string find_file(std::string_view name, const std::string& from,
                      SourceRange place, Interpreter& in);

// The path relative to the design's folder, plain and in quotes.
std::string relative_path(const std::string& path, Frame& frame);
std::string relative_quoted(const std::string& path, Frame& frame);

// The deprecated `origin` of a drawing; messages of 2021.01 call the module
// `shown_name`.
Vec2 read_origin(const Value& origin, std::string_view shown_name,
                 const ModuleCall& call);

// "file = …, layer = …, origin = […], ".
std::string drawing_text(const ImportParams& drawing, Frame& frame);

// "timestamp = " and the seconds of the last change, 0 if it is not there.
std::string timestamp_text(const std::string& path, Frame& frame);

}  // namespace lamina::csg
