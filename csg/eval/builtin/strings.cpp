// Built-in functions of strings (see functions.h).

#include <fmt/format.h>

#include "base/utf8.h"
#include "csg/eval/builtin/call.h"
#include "csg/eval/builtin/functions.h"
#include "csg/eval/run/each_value.h"
#include "csg/eval/value/object.h"
#include "csg/eval/value/text.h"

namespace lamina::csg {

namespace {

Value builtin_str(const CallCode& code, Frame& frame) {
  // Append to the first argument: mostly it is what was built so far.
  if (code.arguments.empty()) return Value::string("");
  Value result = argument(code, 0, frame);
  std::string text;
  if (!result.is_string()) {
    append_text(result, text);
    result = Value();
  }
  for (std::size_t i = 1; i < code.arguments.size(); ++i) {
    Value spill;
    append_text(look(code.arguments[i].value, frame, spill), text);
  }
  return result.is_string() ? result.with_appended(text) : Value::string(text);
}

void append_characters(const Value& value, Frame& frame, std::string& text) {
  switch (value.type()) {
    case Type::kNumber:
      append_utf8(value.as_number(), text);
      return;
    case Type::kVector:
      for (const Value& element : value.as_vector()) {
        append_characters(element, frame, text);
      }
      return;
    case Type::kRange:
      for_each_value(
          value, kMostStatementElements, {}, frame,
          [&](const Value& one) { append_utf8(one.as_number(), text); });
      return;
    default:
      return;
  }
}

Value builtin_chr(const CallCode& code, Frame& frame) {
  std::string text;
  for (std::size_t i = 0; i < code.arguments.size(); ++i) {
    append_characters(argument(code, i, frame), frame, text);
  }
  return Value::string(text);
}

Value builtin_ord(const CallCode& code, Frame& frame) {
  const std::size_t n = code.arguments.size();
  if (n != 1 && !frame.in.is_2021()) return wrong_count(code, frame, "1");
  if (n == 0) return Value();
  if (n > 1) {
    return warn(code, frame,
                "ord() called with {} arguments, only 1 argument expected", n);
  }
  const Value value = argument(code, 0, frame);
  if (!value.is_string()) {
    if (!frame.in.is_2021()) {
      return wrong_type(code, frame, 0, Type::kString, value);
    }
    return warn(code, frame, "ord() argument {} is not of type string",
                to_echo(value));
  }
  // To OpenSCAD a string ends at its first zero byte.
  std::string_view text = value.as_string();
  text = text.substr(0, text.find('\0'));
  if (!is_valid_utf8(text)) {
    return warn(code, frame, "ord() argument '{}' is not a valid utf8 string",
                text);
  }
  if (text.empty()) return Value();
  return Value(static_cast<double>(first_code_point(text)));
}

Value builtin_len(const CallCode& code, Frame& frame) {
  return with_argument(code, frame, [&](const Value& value) {
    if (value.is_vector()) {
      return Value(static_cast<double>(value.as_vector().size()));
    }
    if (value.is_string()) {
      return Value(static_cast<double>(value.character_count()));
    }
    if (value.is_object()) {
      return Value(
          static_cast<double>(value.as_object().keys.as_vector().size()));
    }
    return wrong_type(code, frame, 0, Type::kString, value);
  });
}

}  // namespace

std::span<const BuiltinFunctionRow> string_rows() {
  static constexpr BuiltinFunctionRow kRows[] = {
      {"str", builtin_str},
      {"chr", builtin_chr},
      {"ord", builtin_ord},
      {"len", builtin_len},
  };
  return kRows;
}

}  // namespace lamina::csg
