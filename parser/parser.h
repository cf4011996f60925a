#pragma once
// From text to syntax tree: the grammar of OpenSCAD 2021.01.
//
// Bison and Flex build the parser from grammar/scad.yy and grammar/scad.ll.
// `include <file>` is resolved while reading, since it may stand anywhere a
// blank may; `use <file>` is found while reading but parsed by the Loader
// afterwards, as OpenSCAD does.

#include "base/diagnostic.h"
#include "base/source.h"
#include "parser/ast.h"

namespace lamina {

class Loader;

// Parses `source` and all that it includes.
//
// source       must outlive the program; a byte 0x03 in it stands between the
//              file and what `-D` appends: assignments behind it overwrite
//              without a warning
// user         the file whose `use` asks for this one; null for a main file
//              (OpenSCAD shows names of files relative to its folder)
// loader       opens includes and finds used files
// diagnostics  gets missing files, overwritten variables and every syntax error
// throws       SyntaxError (the first one) at the end of a text with errors.
//              They are already reported then
ast::Program parse(const Source& source, const Source* user, Loader& loader,
                   Diagnostics& diagnostics);

}  // namespace lamina
