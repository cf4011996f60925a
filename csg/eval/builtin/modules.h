#pragma once
// The built-in modules of the language, but for the control structures that
// have code of their own (if, for, let, …).

#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "csg/eval/code/code.h"
#include "csg/eval/run/interpreter.h"
#include "csg/tree.h"

namespace lamina::csg {

struct BuiltinModuleEntry {
  BuiltinModule handler = nullptr;
  std::vector<Parameter> parameters;  // the positional ones first
  std::size_t positional_count = 0;
  std::string_view replacement;  // of a deprecated module
  bool needs_late_argument = false;
};

// Null where there is no such module.
const BuiltinModuleEntry* find_builtin_module(std::string_view name,
                                              Language language);

std::vector<std::string_view> builtin_module_names();

// --- For the files that define them ---

// A call of a module, and the values that it gives to parameters.
class ModuleCall {
 public:
  // Runs the arguments.
  ModuleCall(const BuiltinModuleCode& called, Frame& caller);
  // The value of a parameter, which must be one of the module's; undef where
  // the call gives none.
  const Value& operator[](std::string_view parameter) const;

  // More parameters no module has.
  static constexpr std::size_t kMost = 16;

  // Warns at the call.
  template <typename... Values>
  void warn(fmt::format_string<Values...> words, Values&&... values) const {
    in.warn(code.range, fmt::format(words, std::forward<Values>(values)...));
  }

  const BuiltinModuleCode& code;
  Frame& frame;
  Interpreter& in;

 private:
  Value values_[kMost];
};

// For modules that take no children; 2021.01 warns of those of primitives only.
void warn_of_children(const BuiltinModuleCode& code, Frame& frame);

// `$fn $fa $fs $fe` within their limits; a change is warned of.
Facets clamped_facets(const ModuleCall& call);
// Clamped in 2026; 2021.01 clamps those of primitives only.
Facets facets_of(const ModuleCall& call);

// Run the block of a module, the first before the module looks at `$`
// variables.
inline void begin_block(const Block& block, Frame& frame) {
  if (block.assigns_before_call) run_assignments(block, frame);
}
inline void end_block(const Block& block, Frame& frame) {
  if (!block.assigns_before_call) run_assignments(block, frame);
  run_statements(block, frame);
}

// Runs a module that changes its children; `make` makes the operation of the
// call. In 2021 it sees what is assigned among the children.
template <auto make>
void run_operation(const BuiltinModuleCode& code, Frame& frame) {
  const std::size_t mark = frame.in.node_mark();
  const ModuleCall call(code, frame);
  begin_block(*code.block, frame);
  const auto op = make(call);
  end_block(*code.block, frame);
  frame.in.make_node(op, code, mark);
}

// Entries of one file: name, handler, positional parameters, further ones, all
// of 2021.01; and all of 2026, in their order, where these are others.
struct BuiltinModuleRow {
  std::string_view name;
  BuiltinModule handler;
  std::vector<std::string_view> positional;
  std::vector<std::string_view> optional = {};
  std::string_view replacement = {};
  std::vector<std::string_view> newer = {};
};
std::vector<BuiltinModuleRow> primitive_rows();
std::vector<BuiltinModuleRow> operation_rows();
std::vector<BuiltinModuleRow> transform_rows();
std::vector<BuiltinModuleRow> file_rows();

}  // namespace lamina::csg
