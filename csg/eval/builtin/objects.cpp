// Functions about objects (see functions.h).

#include <filesystem>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "csg/eval/builtin/call.h"
#include "csg/eval/builtin/file_paths.h"
#include "csg/eval/builtin/functions.h"
#include "csg/eval/builtin/json.h"
#include "csg/eval/value/object.h"
#include "csg/eval/value/text.h"

namespace lamina::csg {

namespace {

namespace fs = std::filesystem;

// --- object -----------------------------------------------------------------

constexpr std::string_view kEntryHelp =
    "In an unnamed list, entries must be [key,value] to set or [key] to "
    "delete. The key must be <string>.";

// What is wrong with an entry of a list; empty: nothing. `where` and `i` say
// where it stands.
std::string find_fault(const Value& entry, std::size_t where, std::size_t i) {
  const std::span<const Value> parts = entry.elements();
  const std::string place = fmt::format("Argument {} [Element {} ", where, i);
  if (!entry.is_vector()) {
    return fmt::format(
        "object( {}<{}>] ) Entry type is not a list, it is <{}>. {}", place,
        type_name(entry.type()), type_name(entry.type()), kEntryHelp);
  }
  if (parts.empty()) {
    return fmt::format("object({}[]]) Entry is empty. {}", place, kEntryHelp);
  }
  if (parts.size() > 2) {
    return fmt::format(
        "object({}[...]]) Entry length is {}, must be 1 [key] or 2 "
        "[key,value]. {}",
        place, parts.size(), kEntryHelp);
  }
  if (parts[0].is_string()) return {};
  const std::string_view type = type_name(parts[0].type());
  return fmt::format(
      "object({}[<{}>{}]]) The key of the entry is not <string> but <{}>. {}",
      place, type, parts.size() == 2 ? ",value" : "", type, kEntryHelp);
}

// Sets and removes what an unnamed argument says, up to its first fault.
std::string edit(const Value& edits, std::size_t where,
                 ObjectBuilder& builder) {
  if (edits.is_object()) {
    builder.set_all(edits);
    return {};
  }
  if (!edits.is_vector()) {
    // The blank at the end is OpenSCAD's.
    return fmt::format(
        "object(Argument {} <{}>) An unnamed argument must be either <object> "
        "or <list>, it is <{}>. ",
        where, type_name(edits.type()), type_name(edits.type()));
  }
  const std::span<const Value> entries = edits.as_vector();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    std::string fault = find_fault(entries[i], where, i);
    if (!fault.empty()) return fault;
    const std::span<const Value> parts = entries[i].as_vector();
    if (parts.size() == 2) {
      builder.set(parts[0], parts[1]);
    } else {
      builder.remove(parts[0].as_string());
    }
  }
  return {};
}

}  // namespace

Value builtin_object(const CallCode& code, Frame& frame) {
  ObjectBuilder builder;
  for (std::size_t i = 0; i < code.arguments.size(); ++i) {
    const WrittenArgument& argument = code.arguments[i];
    Value value = run(argument.value, frame);
    if (!argument.name.empty()) {
      builder.set(Value::string(argument.name), std::move(value));
      continue;
    }
    std::string fault = edit(value, i, builder);
    if (!fault.empty()) return warn_in_file(code, frame, "{}", fault);
  }
  return builder.finish();
}

Value builtin_has_key(const CallCode& code, Frame& frame) {
  if (code.arguments.size() != 2) return wrong_count_of_new(code, frame, "2");
  const Value object = run(code.arguments[0].value, frame);
  const Value key = run(code.arguments[1].value, frame);
  if (!object.is_object()) {
    return wrong_type_of_new(code, frame, 0, Type::kObject, object);
  }
  if (!key.is_string()) {
    return wrong_type_of_new(code, frame, 1, Type::kString, key);
  }
  return Value(has_member(object, key.as_string()));
}

Value builtin_is_object(const CallCode& code, Frame& frame) {
  if (code.arguments.size() != 1) return wrong_count_of_new(code, frame, "1");
  return Value(run(code.arguments[0].value, frame).is_object());
}

// --- import -----------------------------------------------------------------

Value builtin_import(const CallCode& code, Frame& frame) {
  static constexpr std::string_view kNames[] = {"file"};
  const Value file = run_named_arguments(kNames, 1, code, frame)[0];
  const std::string name = file.is_string() ? to_text(file) : std::string();
  const fs::path caller = fs::absolute(code.range.source->path());
  const std::string path =
      find_file(name, caller.parent_path().string(), code.range, frame.in);
  frame.in.add_file(path);
  JsonResult result = read_json(path, frame.in.file_access());
  if (!result.can_read) {
    return warn_in_file(code, frame, "Could not read file '{}'", path);
  }
  if (!result.fault.empty()) {
    return warn_in_file(code, frame, "Failed to parse file '{}': {}", path,
                        result.fault);
  }
  return std::move(result.value);
}

}  // namespace lamina::csg
