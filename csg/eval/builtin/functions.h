#pragma once
// The built-in functions of the language.

#include <span>
#include <string_view>

#include "csg/eval/code/code.h"

namespace lamina::csg {

// One of the two is set.
struct BuiltinFunctionEntry {
  BuiltinFunction function = nullptr;
  MathFunction math = nullptr;  // a function of one number
};

// Null where there is no such function.
const BuiltinFunctionEntry* find_builtin_function(std::string_view name);

// Calls a function of one number, with OpenSCAD's warnings for anything else.
Value call_math(const CallCode& code, Frame& frame);

// Known by address: its argument is resolved without a warning.
Value builtin_is_undef(const CallCode& code, Frame& frame);

// --- For the files that define them ---

struct BuiltinFunctionRow {
  std::string_view name;
  BuiltinFunction function;
  MathFunction math;
};
std::span<const BuiltinFunctionRow> number_rows();
std::span<const BuiltinFunctionRow> string_rows();
std::span<const BuiltinFunctionRow> vector_rows();

}  // namespace lamina::csg
