#pragma once
// Values as text: what `echo`, `str` and the `.csg` file show.
//
// OpenSCAD writes the numbers of values with double-conversion (six significant
// digits, zeros at the end cut off: 1e+6) and those of most module parameters
// with C++ streams (`%g`: 1e+06). Both are here, because a `.csg` file mixes
// them.

#include <string>

#include "base/text.h"
#include "csg/eval/value/value.h"
#include "parser/ast.h"

namespace lamina::csg {

// Appends a number as C++ streams show it: 0.333333, 1e+06, inf, -nan, -0.
void append_stream_number(double number, std::string& text);

// Appends a value as `str` shows it: a string bare, but quoted inside a vector.
void append_text(const Value& value, std::string& text);

// Appends a value as `echo` shows it: a string always quoted, never escaped.
void append_echo(const Value& value, std::string& text);

std::string to_text(const Value& value);
std::string to_echo(const Value& value);

// An expression as OpenSCAD shows it in messages.
std::string expression_text(const ast::Expr& expression);

}  // namespace lamina::csg
