#include "csg/eval/builtin/functions.h"

#include <cmath>
#include <unordered_map>

#include <fmt/format.h>

#include "csg/eval/builtin/call.h"
#include "csg/eval/builtin/dxf.h"
#include "csg/eval/builtin/metrics.h"
#include "csg/eval/builtin/objects.h"
#include "csg/eval/builtin/search.h"
#include "csg/eval/value/integers.h"
#include "csg/eval/run/interpreter.h"

namespace lamina::csg {

namespace {

// --- About the program and its values ---------------------------------------

constexpr double kVersion[] = {2021, 1, 0};

Value builtin_version(const CallCode&, Frame&) {
  return Value::numbers(kVersion);
}

Value builtin_version_num(const CallCode& code, Frame& frame) {
  const Value version = code.arguments.empty() ? Value::numbers(kVersion)
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
    if (!value.is_number()) return Value();
    number = value.as_number();
  } else if (code.arguments.size() > 1) {
    return wrong_count(code, frame);
  }
  const int n = cut_to_int(number);
  const auto& names = frame.in.module_names;
  if (n < 0) {
    return warn(code, frame,
                fmt::format("Negative parent module index ({}) "
                            "not allowed",
                            n));
  }
  if (n >= static_cast<int>(names.size())) {
    return warn(code, frame,
                fmt::format("Parent module index ({}) greater than the number "
                            "of modules on the stack",
                            n));
  }
  return Value::string(names[names.size() - 1 - static_cast<std::size_t>(n)]);
}

template <Type type>
Value is_type(const CallCode& code, Frame& frame) {
  if (code.arguments.size() != 1) return wrong_count(code, frame);
  Value spill;
  return Value(look(code.arguments[0].value, frame, spill).type() == type);
}

Value builtin_is_num(const CallCode& code, Frame& frame) {
  if (code.arguments.size() != 1) return wrong_count(code, frame);
  Value spill;
  const Value& value = look(code.arguments[0].value, frame, spill);
  return Value(value.is_number() && !std::isnan(value.as_number()));
}

std::span<const BuiltinFunctionRow> program_rows() {
  static constexpr BuiltinFunctionRow kRows[] = {
      {"search", builtin_search, nullptr},
      {"version", builtin_version, nullptr},
      {"version_num", builtin_version_num, nullptr},
      {"parent_module", builtin_parent_module, nullptr},
      {"dxf_dim", builtin_dxf_dim, nullptr},
      {"dxf_cross", builtin_dxf_cross, nullptr},
      {"is_undef", builtin_is_undef, nullptr},
      {"is_bool", is_type<Type::kBool>, nullptr},
      {"is_string", is_type<Type::kString>, nullptr},
      {"is_list", is_type<Type::kVector>, nullptr},
      {"is_function", is_type<Type::kFunction>, nullptr},
      {"is_num", builtin_is_num, nullptr},
      {"is_object", builtin_is_object, nullptr},
      {"object", builtin_object, nullptr},
      {"has_key", builtin_has_key, nullptr},
      {"import", builtin_import, nullptr},
      {"textmetrics", builtin_textmetrics, nullptr},
      {"fontmetrics", builtin_fontmetrics, nullptr},
  };
  return kRows;
}

using Table = std::unordered_map<std::string_view, BuiltinFunctionEntry>;

const Table& builtin_table() {
  static const Table table = [] {
    Table all;
    for (const auto rows :
         {number_rows(), string_rows(), vector_rows(), program_rows()}) {
      for (const BuiltinFunctionRow& row : rows) {
        all[row.name] = {row.function, row.math};
      }
    }
    return all;
  }();
  return table;
}

}  // namespace

Value builtin_is_undef(const CallCode& code, Frame& frame) {
  if (code.arguments.size() != 1) return wrong_count(code, frame);
  Value spill;
  return Value(look(code.arguments[0].value, frame, spill).is_undef());
}

Value call_math(const CallCode& code, Frame& frame) {
  if (code.arguments.size() != 1) return wrong_count(code, frame);
  Value spill;
  const Value& value = look(code.arguments[0].value, frame, spill);
  if (!value.is_number()) return wrong_type(code, frame);
  return Value(code.math(value.as_number()));
}

const BuiltinFunctionEntry* find_builtin_function(std::string_view name) {
  const auto entry = builtin_table().find(name);
  return entry == builtin_table().end() ? nullptr : &entry->second;
}

}  // namespace lamina::csg
