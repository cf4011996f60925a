#include "csg/eval/builtin/functions.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "csg/eval/builtin/call.h"
#include "csg/eval/run/interpreter.h"
#include "csg/eval/value/operators.h"

namespace lamina::csg {

namespace {

// --- About the program and its values ---------------------------------------

// The version of the OpenSCAD that the design is written for.
Value version_of(Language language) {
  constexpr double k2021[] = {2021, 1, 0};
  constexpr double k2026[] = {2026, 7, 20};
  return Value::numbers(language == Language::k2021 ? k2021 : k2026);
}

Value builtin_version(const CallCode&, Frame& frame) {
  return version_of(frame.in.language());
}

Value builtin_version_num(const CallCode& code, Frame& frame) {
  const Value version = code.arguments.empty() ? version_of(frame.in.language())
                                               : argument(code, 0, frame);
  const std::span<const Value> parts = version.elements();
  if (parts.size() != 2 && parts.size() != 3) return Value();
  double number = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (i < parts.size() && !parts[i].is_number()) return Value();
    number = number * 100 + (i < parts.size() ? parts[i].as_number() : 0);
  }
  return Value(number);
}

Value builtin_parent_module(const CallCode& code, Frame& frame) {
  ++frame.in.effects();
  double number = 1;
  if (code.arguments.size() == 1) {
    const Value value = argument(code, 0, frame);
    if (!value.is_number()) {
      return newly_wrong_type(code, frame, 0, Type::kNumber, value);
    }
    number = value.as_number();
  } else if (code.arguments.size() > 1) {
    return wrong_count(code, frame, "1");
  }
  const int n = cut_to<int>(number);
  const auto& names = frame.in.module_names;
  if (n < 0) {
    return warn(code, frame, "Negative parent module index ({}) not allowed",
                n);
  }
  if (n >= static_cast<int>(names.size())) {
    return warn(code, frame,
                "Parent module index ({}) greater than the number of modules "
                "on the stack",
                n);
  }
  return Value::string(names[names.size() - 1 - static_cast<std::size_t>(n)]);
}

template <Type type>
Value is_type(const CallCode& code, Frame& frame) {
  return with_argument(code, frame, [](const Value& value) {
    return Value(value.type() == type);
  });
}

Value builtin_is_num(const CallCode& code, Frame& frame) {
  return with_argument(code, frame, [](const Value& value) {
    return Value(value.is_number() && !std::isnan(value.as_number()));
  });
}

// A function that 2021.01 lacks.
template <BuiltinFunction function>
Value newer(const CallCode& code, Frame& frame) {
  frame.in.note_newer(code.range, code.name);
  return function(code, frame);
}

std::span<const BuiltinFunctionRow> program_rows() {
  static constexpr BuiltinFunctionRow kRows[] = {
      {"search", builtin_search},
      {"version", builtin_version},
      {"version_num", builtin_version_num},
      {"parent_module", builtin_parent_module},
      {"dxf_dim", builtin_dxf_dim},
      {"dxf_cross", builtin_dxf_cross},
      {"is_undef", builtin_is_undef},
      {"is_bool", is_type<Type::kBool>},
      {"is_string", is_type<Type::kString>},
      {"is_list", is_type<Type::kVector>},
      {"is_function", is_type<Type::kFunction>},
      {"is_num", builtin_is_num},
      {"is_object", newer<builtin_is_object>},
      {"object", newer<builtin_object>},
      {"has_key", newer<builtin_has_key>},
      {"import", newer<builtin_import>},
      {"textmetrics", newer<builtin_textmetrics>},
      {"fontmetrics", newer<builtin_fontmetrics>},
  };
  return kRows;
}

using FunctionTable =
    std::unordered_map<std::string_view, const BuiltinFunctionRow*>;

const FunctionTable& builtin_table() {
  static const FunctionTable table = [] {
    FunctionTable all;
    for (const auto rows :
         {number_rows(), string_rows(), vector_rows(), program_rows()}) {
      for (const BuiltinFunctionRow& row : rows) {
        all[row.name] = &row;
      }
    }
    return all;
  }();
  return table;
}

}  // namespace

Value builtin_is_undef(const CallCode& code, Frame& frame) {
  return with_argument(
      code, frame, [](const Value& value) { return Value(value.is_undef()); });
}

Value call_math(const CallCode& code, Frame& frame) {
  return with_argument(code, frame, [&](const Value& value) {
    return value.is_number() ? Value(code.math(value.as_number()))
                             : wrong_type(code, frame, 0, Type::kNumber, value);
  });
}

const BuiltinFunctionRow* find_builtin_function(std::string_view name) {
  const auto row = builtin_table().find(name);
  return row == builtin_table().end() ? nullptr : row->second;
}

std::vector<std::string_view> builtin_function_names() {
  std::vector<std::string_view> names;
  for (const auto& [name, row] : builtin_table()) names.push_back(name);
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace lamina::csg
