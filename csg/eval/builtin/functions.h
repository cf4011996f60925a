#pragma once
// The built-in functions of the language.

#include <span>
#include <string_view>
#include <vector>

#include "csg/eval/code/code.h"

namespace lamina::csg {

struct BuiltinFunctionRow {
  std::string_view name;
  BuiltinFunction function;
  MathFunction math = nullptr;  // what call_math() calls
};

// Null where there is no such function.
const BuiltinFunctionRow* find_builtin_function(std::string_view name);

std::vector<std::string_view> builtin_function_names();

// The resolver knows it by its address, since its argument does not warn.
Value builtin_is_undef(const CallCode& code, Frame& frame);

// --- For the files that define them ---

// Calls a function of one number, with OpenSCAD's warnings for anything else.
Value call_math(const CallCode& code, Frame& frame);

// search(): where values stand in a string, a list or the column of a table.
Value builtin_search(const CallCode& code, Frame& frame);

// dxf_dim() and dxf_cross(): the value of a dimension of a drawing, found by
// its name and layer, and where the first two lines of a layer that touch no
// other line would meet.
Value builtin_dxf_dim(const CallCode& code, Frame& frame);
Value builtin_dxf_cross(const CallCode& code, Frame& frame);

// What follows is newer than OpenSCAD 2021.01.
//
// object(…) makes an object member by member. `name = value` sets one, an
// object sets all of its own, a list of [name, value] and [name] sets and
// removes. import(file) is what a JSON file holds.
Value builtin_object(const CallCode& code, Frame& frame);
Value builtin_has_key(const CallCode& code, Frame& frame);
Value builtin_is_object(const CallCode& code, Frame& frame);
Value builtin_import(const CallCode& code, Frame& frame);

// Both return an object; undef where there is no font.
Value builtin_textmetrics(const CallCode& code, Frame& frame);
Value builtin_fontmetrics(const CallCode& code, Frame& frame);

std::span<const BuiltinFunctionRow> number_rows();
std::span<const BuiltinFunctionRow> string_rows();
std::span<const BuiltinFunctionRow> vector_rows();

}  // namespace lamina::csg
