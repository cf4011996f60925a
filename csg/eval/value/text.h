#pragma once
// Values as text: what `echo`, `str` and the `.csg` file show.

#include <cstdint>
#include <string>

#include "base/text.h"
#include "csg/eval/value/value.h"
#include "parser/ast.h"

namespace lamina::csg {

// How deep vectors may be nested to be shown: half of what OpenSCAD's stack
// lets them be. A recursion that prints what it nests ends here, before its
// texts fill the memory.
inline constexpr std::uint32_t kDeepestText = 10000;

// Thrown by all of these where a value is nested deeper.
struct TextTooDeep {};

// Appends a value as `str` shows it: a string bare, but quoted inside a vector.
void append_text(const Value& value, std::string& text);

// Appends a value as `echo` shows it: a string always quoted, never escaped.
void append_echo(const Value& value, std::string& text);

std::string to_text(const Value& value);
std::string to_echo(const Value& value);

// An expression as OpenSCAD shows it in messages.
std::string expression_text(const ast::Expr& expression);

}  // namespace lamina::csg
