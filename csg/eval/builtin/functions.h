#pragma once
// The built-in functions of the language.

#include <span>
#include <string_view>

#include "csg/eval/code/code.h"

namespace lamina::csg {

struct BuiltinFunctionRow {
  std::string_view name;
  BuiltinFunction function;
  MathFunction math = nullptr;  // what call_math() calls
};

// Null where there is no such function.
const BuiltinFunctionRow* find_builtin_function(std::string_view name);

// The resolver knows it by its address, since its argument does not warn.
Value builtin_is_undef(const CallCode& code, Frame& frame);

// --- For the files that define them ---

// Calls a function of one number, with OpenSCAD's warnings for anything else.
Value call_math(const CallCode& code, Frame& frame);

std::span<const BuiltinFunctionRow> number_rows();
std::span<const BuiltinFunctionRow> string_rows();
std::span<const BuiltinFunctionRow> vector_rows();

}  // namespace lamina::csg
