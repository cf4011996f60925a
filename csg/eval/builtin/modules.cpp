#include "csg/eval/builtin/modules.h"

#include <algorithm>
#include <optional>
#include <unordered_map>

#include <fmt/format.h>

#include "csg/eval/builtin/conversions.h"
#include "csg/eval/code/argument_plan.h"
#include "csg/eval/run/arguments.h"
#include "csg/eval/run/each_value.h"
#include "csg/eval/value/operators.h"
#include "csg/eval/value/text.h"

namespace lamina::csg {

ModuleCall::ModuleCall(const BuiltinModuleCode& called, Frame& caller)
    : code(called), frame(caller), in(caller.in) {
  if (code.plan->has_newer_argument) {
    in.note_newer(code.range, "an argument that 2021.01 does not know");
  }
  in.warn_of_arguments(*code.plan, code.range, frame.document);
  bind(run_arguments(*code.plan, code.arguments, frame,
                     [&](const Target& target, Value&& value) {
                       if (target.kind == Target::Kind::kSlot) {
                         values_[target.index] = std::move(value);
                       } else {
                         in.assign(target, std::move(value), frame);
                       }
                     }),
       in);
}

const Value& ModuleCall::operator[](std::string_view parameter) const {
  std::size_t i = 0;
  while (code.parameters[i].name != parameter) ++i;
  return values_[i];
}

void warn_of_children(const BuiltinModuleCode& code, Frame& frame) {
  if (code.block->statements.empty()) return;
  // What follows without a brace was hardly meant as a child.
  const SourceRange range = code.range;
  const std::string_view rest =
      std::string_view(range.source->text()).substr(range.end);
  const std::size_t next = rest.find_first_not_of(" \t\r\n");
  std::vector<Note> hints;
  if (next != std::string_view::npos && rest[next] != '{') {
    hints.push_back(
        {{range.source, range.end, range.end}, "is a ';' missing here?"});
  }
  frame.in.warn(
      range,
      fmt::format("module {}() does not support child modules", code.name),
      nullptr, std::move(hints));
}

Facets clamped_facets(const ModuleCall& call) {
  constexpr double kLeast = 0.01;
  Facets facets = current_facets(call.in);
  const auto clamp_sign = [&](double& value, const char* name) {
    if (!(value < 0) || call.in.is_2021()) return;
    call.warn("{} negative - setting to 0", name);
    value = 0;
  };
  const auto clamp = [&](double& value, const char* name) {
    if (!(value < kLeast)) return;
    call.warn("{} too small - clamping to {:f}", name, kLeast);
    value = kLeast;
  };
  clamp_sign(facets.fn, "$fn");
  clamp_sign(facets.fe, "$fe");
  clamp(facets.fs, "$fs");
  clamp(facets.fa, "$fa");
  return facets;
}

Facets facets_of(const ModuleCall& call) {
  return call.in.is_2021() ? current_facets(call.in) : clamped_facets(call);
}

namespace {

template <typename... Parts>
void warn_at(SourceRange place, Frame& frame,
             fmt::format_string<Parts...> words, Parts&&... parts) {
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

// Whether there is a child of that number; warns if not.
bool has_child(int n, SourceRange place, Frame& frame) {
  const bool is_2021 = frame.in.is_2021();
  if (n >= 0 && static_cast<std::size_t>(n) < count_children(frame)) {
    return true;
  }
  if (is_2021 && n < 0) {
    warn_at({}, frame, "Negative children index ({}) not allowed", n);
  } else {
    warn_at(is_2021 ? SourceRange() : place, frame,
            "Children index ({}) out of bounds ({} children)", n,
            count_children(frame));
  }
  return false;
}

// Calls `take` with each number in `which`, the argument of children(). False
// where that is not an argument for it, which is warned of.
template <typename Take>
bool for_each_index(const Value& which, SourceRange place, Frame& frame,
                    const Take& take) {
  switch (which.type()) {
    case Type::kNumber:
      take(cut_to<int>(which.as_number()));
      return true;
    case Type::kVector:
      for (const Value& one : which.as_vector()) {
        if (one.is_number()) {
          take(cut_to<int>(one.as_number()));
        } else {
          warn_at({}, frame,
                  "Bad parameter type ({}) for children, only "
                  "accept: empty, number, vector, range.",
                  to_text(one));
        }
      }
      return true;
    case Type::kRange: {
      const Range& range = which.as_range();
      const std::uint32_t count = range.count();
      if (count >= kMostStatementElements) {
        warn_at(place, frame,
                "Bad range parameter for children: too many elements ({})",
                count);
        return false;
      }
      for (std::uint32_t i = 0; range.step != 0 && i < count; ++i) {
        take(cut_to<int>(range.at(i)));
      }
      return true;
    }
    default:
      warn_at(place, frame,
              "Bad parameter type ({}) for children, only "
              "accept: empty, number, vector, range",
              to_echo(which));
      return false;
  }
}

// The argument that says which children; none where all are meant. 2021.01
// takes the first for it, whatever its name, and no other counts.
std::optional<Value> index_of_children(const BuiltinModuleCode& code,
                                       Frame& frame) {
  if (frame.in.is_2021()) {
    if (code.arguments.empty()) return std::nullopt;
    if (const std::string_view name = code.arguments[0].name;
        !name.empty() && name != "index") {
      frame.in.note_difference(code.range, "arguments of children()");
    }
    return run(code.arguments[0].value, frame);
  }
  const ModuleCall call(code, frame);
  const bool is_given =
      std::ranges::any_of(code.plan->bound, [](const BoundArgument& bound) {
        return bound.target.kind == Target::Kind::kSlot;
      });
  return is_given ? std::optional(call["index"]) : std::nullopt;
}

// In 2021.01 one child alone is not grouped, and the children see what was
// assigned before the call; since then each children() assigns it anew.
void children(const BuiltinModuleCode& code, Frame& frame) {
  if (!frame.in.is_2021()) warn_of_children(code, frame);
  if (frame.children == nullptr) return;  // not inside a module
  const std::size_t mark = frame.in.node_mark();
  const bool is_2021 = frame.in.is_2021();
  if (is_2021 && frame.children->reads_dynamic) {
    frame.in.note_difference(frame.children->assignments[0].range,
                             "in 2021.01 it does not see what the module sets");
  }
  const std::optional<Value> index = index_of_children(code, frame);
  if (!index) {
    if (!is_2021) run_assignments(*frame.children, *frame.children_frame);
    run_statements(*frame.children, *frame.children_frame);
    frame.in.make_node(Group{}, code, mark);
    return;
  }
  const Value& which = *index;
  std::vector<std::size_t> chosen;
  const bool is_fine = for_each_index(which, code.range, frame, [&](int n) {
    if (!has_child(n, code.range, frame)) return;
    if (is_2021) {
      run_child(static_cast<std::size_t>(n), frame);
    } else {
      chosen.push_back(static_cast<std::size_t>(n));
    }
  });
  if (!is_fine || (which.is_number() && (is_2021 || chosen.empty()))) return;
  if (!is_2021) run_assignments(*frame.children, *frame.children_frame);
  for (const std::size_t n : chosen) run_child(n, frame);
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
      warn_at(code.range, frame, "Negative child index ({}) not allowed", n);
      return;
    }
  }
  if (frame.children == nullptr) return;
  if (static_cast<std::size_t>(n) >= count_children(frame)) {
    warn_at(code.range, frame, "Child index ({}) out of bounds ({} children)",
            n, count_children(frame));
    return;
  }
  const std::size_t mark = frame.in.node_mark();
  run_child(static_cast<std::size_t>(n), frame);
  if (!frame.in.is_2021()) frame.in.make_node(Group{}, code, mark);
}

// --- The table --------------------------------------------------------------

using ModuleTable = std::unordered_map<std::string_view, BuiltinModuleEntry>;

// In 2026 every parameter can be given by its place. What only the other
// language has is understood, too, but calls that give it are warned.
BuiltinModuleEntry make_entry(const BuiltinModuleRow& row, Language language) {
  BuiltinModuleEntry entry;
  entry.handler = row.handler;
  entry.replacement = row.replacement;
  std::vector<std::string_view> names = row.positional;
  names.insert(names.end(), row.optional.begin(), row.optional.end());
  std::vector<std::string_view> others = row.newer.empty() ? names : row.newer;
  entry.positional_count = row.positional.size();
  if (language != Language::k2021) {
    std::swap(names, others);
    entry.positional_count = names.size();
  }
  const std::size_t own = names.size();
  for (const std::string_view name : others) {
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      names.push_back(name);
    }
  }
  LAMINA_CHECK_EQ(names.size() <= ModuleCall::kMost, true);
  entry.parameters = make_parameters(names);
  for (std::size_t i = own; i < names.size(); ++i) {
    entry.parameters[i].is_extra = true;
  }
  return entry;
}

void add_rows(const std::vector<BuiltinModuleRow>& rows, Language language,
              ModuleTable& table) {
  for (const BuiltinModuleRow& row : rows) {
    table[row.name] = make_entry(row, language);
  }
}

ModuleTable make_table(Language language) {
  ModuleTable made;
  add_rows({{"echo", echo, {}},
            {"children", children, {}, {}, {}, {"index"}},
            {"child", child, {}}},
           language, made);
  add_rows(primitive_rows(), language, made);
  add_rows(operation_rows(), language, made);
  add_rows(transform_rows(), language, made);
  add_rows(file_rows(), language, made);
  if (language == Language::k2021) {
    made["linear_extrude"].needs_late_argument = true;
    made["dxf_linear_extrude"].needs_late_argument = true;
  }
  return made;
}

const ModuleTable& builtin_table(Language language) {
  if (language == Language::k2021) {
    static const ModuleTable table = make_table(Language::k2021);
    return table;
  }
  static const ModuleTable table = make_table(Language::k2026);
  return table;
}

}  // namespace

const BuiltinModuleEntry* find_builtin_module(std::string_view name,
                                              Language language) {
  const ModuleTable& table = builtin_table(language);
  const auto entry = table.find(name);
  return entry == table.end() ? nullptr : &entry->second;
}

std::vector<std::string_view> builtin_module_names() {
  std::vector<std::string_view> names = {"for", "intersection_for", "let",
                                         "assign", "assert"};
  for (const auto& [name, entry] : builtin_table(Language::k2026)) {
    names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace lamina::csg
