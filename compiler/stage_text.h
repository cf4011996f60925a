#pragma once
// Products of stages before layers, as text.

#include <string>
#include <string_view>

#include "compiler/compilation.h"

namespace lamina::compiler {

// The text that the format of the output asks for: the syntax tree, the
// parameters as JSON, all messages so far as openscad's `.echo` has them, or
// the CSG tree as its `.csg` does.
std::string stage_text(Compilation& compilation);

// What `.echo` has of a design with a syntax error.
std::string text_of_syntax_error(Compilation& compilation);

// Writes a whole file.
void write_file(const std::string& path, std::string_view text,
                TemporaryFiles& temporary_files);

}  // namespace lamina::compiler
