#pragma once
// The built-in modules of the language, but for the control structures that
// have code of their own (if, for, let, …).

#include <cstddef>
#include <string_view>
#include <vector>

#include "csg/eval/code/code.h"

namespace lamina::csg {

struct BuiltinModuleEntry {
  BuiltinModule handler = nullptr;
  std::vector<Parameter> parameters;  // the positional ones first
  std::size_t positional_count = 0;
  std::string_view replacement;  // of a deprecated module
  bool needs_late_argument = false;
};

// Null where there is no such module.
const BuiltinModuleEntry* find_builtin_module(std::string_view name);

// --- For the files that define them ---

// The values that a call gives to a module's parameters, in the order of the
// entry; undef where it gives none.
class ModuleArguments {
 public:
  ModuleArguments(const BuiltinModuleCode& code, Frame& frame);
  const Value& operator[](std::size_t i) const { return values_[i]; }

 private:
  static constexpr std::size_t kMost = 12;
  Value values_[kMost];
};

// Warns at the call.
void warn(const BuiltinModuleCode& code, Frame& frame, std::string message);

// Entries of one file: name, handler, positional parameters, further ones.
struct BuiltinModuleRow {
  std::string_view name;
  BuiltinModule handler;
  std::vector<std::string_view> positional;
  std::vector<std::string_view> optional = {};
  std::string_view replacement = {};
};
std::vector<BuiltinModuleRow> primitive_rows();
std::vector<BuiltinModuleRow> operation_rows();
std::vector<BuiltinModuleRow> transform_rows();
std::vector<BuiltinModuleRow> file_rows();

}  // namespace lamina::csg
