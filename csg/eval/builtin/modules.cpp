#include "csg/eval/builtin/modules.h"

#include <unordered_map>

#include <fmt/format.h>

#include "csg/eval/code/argument_plan.h"
#include "csg/eval/run/each_value.h"
#include "csg/eval/value/operators.h"
#include "csg/eval/value/text.h"

namespace lamina::csg {

ModuleCall::ModuleCall(const BuiltinModuleCode& called, Frame& caller)
    : code(called), frame(caller), in(caller.in) {
  for (const std::string& warning : code.plan->warnings) {
    frame.in.warn(code.range, warning, frame.document);
  }
  for (const BoundArgument& bound : code.plan->bound) {
    Value value = run(code.arguments[bound.written].value, frame);
    if (bound.target.kind == Target::Kind::kSlot) {
      values_[bound.target.index] = std::move(value);
    } else {
      frame.in.assign(bound.target, std::move(value), frame);
    }
  }
}

const Value& ModuleCall::operator[](std::string_view parameter) const {
  std::size_t i = 0;
  while (code.parameters[i].name != parameter) ++i;
  return values_[i];
}

namespace {

template <typename... Parts>
void warn(SourceRange place, Frame& frame, fmt::format_string<Parts...> words,
          Parts&&... parts) {
  frame.in.warn(place, fmt::format(words, std::forward<Parts>(parts)...));
}

// --- echo -------------------------------------------------------------------

void echo(const BuiltinModuleCode& code, Frame& frame) {
  const std::size_t mark = frame.in.node_mark();
  frame.in.echo(echo_text(code.arguments, frame));
  run_block(*code.block, frame);
  if (frame.in.node_mark() > mark) frame.in.make_node(Group{}, code, mark);
}

// --- children ---------------------------------------------------------------

std::size_t count_children(const Frame& frame) {
  return frame.children->statements.size();
}

void run_child(std::size_t n, Frame& frame) {
  instantiate(*frame.children->statements[n], *frame.children_frame);
}

// One of the children by number.
void child_at(int n, Frame& frame) {
  if (n < 0) {
    warn({}, frame, "Negative children index ({}) not allowed", n);
  } else if (static_cast<std::size_t>(n) >= count_children(frame)) {
    warn({}, frame, "Children index ({}) out of bounds ({} children)", n,
         count_children(frame));
  } else {
    run_child(static_cast<std::size_t>(n), frame);
  }
}

void children(const BuiltinModuleCode& code, Frame& frame) {
  if (frame.children == nullptr) return;  // not inside a module
  const std::size_t mark = frame.in.node_mark();
  if (code.arguments.empty()) {
    for (std::size_t n = 0; n < count_children(frame); ++n) {
      run_child(n, frame);
    }
    frame.in.make_node(Group{}, code, mark);
    return;
  }
  const Value which = run(code.arguments[0].value, frame);
  switch (which.type()) {
    case Type::kNumber:
      child_at(cut_to<int>(which.as_number()), frame);
      return;
    case Type::kVector:
      for (const Value& one : which.as_vector()) {
        if (one.is_number()) {
          child_at(cut_to<int>(one.as_number()), frame);
        } else {
          warn({}, frame,
               "Bad parameter type ({}) for children, only "
               "accept: empty, number, vector, range.",
               to_text(one));
        }
      }
      break;
    case Type::kRange: {
      const Range& range = which.as_range();
      const std::uint32_t count = range.count();
      if (count >= kMostStatementElements) {
        warn(code.range, frame,
             "Bad range parameter for children: too many elements ({})", count);
        return;
      }
      for (std::uint32_t i = 0; range.step != 0 && i < count; ++i) {
        child_at(cut_to<int>(range.at(i)), frame);
      }
      break;
    }
    default:
      warn(code.range, frame,
           "Bad parameter type ({}) for children, only "
           "accept: empty, number, vector, range",
           to_echo(which));
      return;
  }
  frame.in.make_node(Group{}, code, mark);
}

// The old child(n), one child only.
void child(const BuiltinModuleCode& code, Frame& frame) {
  frame.in.deprecate(
      {},
      "child() will be removed in future releases. Use children() instead.");
  int n = 0;
  if (!code.arguments.empty()) {
    const Value which = run(code.arguments[0].value, frame);
    if (which.is_number()) n = cut_to<int>(which.as_number());
    if (n < 0) {
      warn(code.range, frame, "Negative child index ({}) not allowed", n);
      return;
    }
  }
  if (frame.children == nullptr) return;
  if (static_cast<std::size_t>(n) >= count_children(frame)) {
    warn(code.range, frame, "Child index ({}) out of bounds ({} children)", n,
         count_children(frame));
    return;
  }
  run_child(static_cast<std::size_t>(n), frame);
}

// --- The table --------------------------------------------------------------

using Table = std::unordered_map<std::string_view, BuiltinModuleEntry>;

void add_rows(const std::vector<BuiltinModuleRow>& rows, Table& table) {
  for (const BuiltinModuleRow& row : rows) {
    BuiltinModuleEntry entry;
    entry.handler = row.handler;
    entry.replacement = row.replacement;
    entry.positional_count = row.positional.size();
    std::vector<std::string_view> names = row.positional;
    names.insert(names.end(), row.optional.begin(), row.optional.end());
    entry.parameters = make_parameters(names);
    table[row.name] = std::move(entry);
  }
}

const Table& builtin_table() {
  static const Table table = [] {
    Table made;
    add_rows(
        {{"echo", echo, {}}, {"children", children, {}}, {"child", child, {}}},
        made);
    add_rows(primitive_rows(), made);
    add_rows(operation_rows(), made);
    add_rows(transform_rows(), made);
    add_rows(file_rows(), made);
    made["linear_extrude"].needs_late_argument = true;
    made["dxf_linear_extrude"].needs_late_argument = true;
    return made;
  }();
  return table;
}

}  // namespace

const BuiltinModuleEntry* find_builtin_module(std::string_view name) {
  const auto entry = builtin_table().find(name);
  return entry == builtin_table().end() ? nullptr : &entry->second;
}

}  // namespace lamina::csg
