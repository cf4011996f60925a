#include "csg/eval/value/text.h"

#include "csg/eval/value/object.h"
#include "parser/ast_printer.h"

namespace lamina::csg {

namespace {

// What is appended may stand `depth` deep in other values.
void append(const Value& value, std::uint32_t depth, std::string& text);

void append_quoted(const Value& value, std::uint32_t depth, std::string& text) {
  if (value.is_string()) {
    text += '"';
    text += value.as_string();
    text += '"';
  } else {
    append(value, depth, text);
  }
}

void append(const Value& value, std::uint32_t depth, std::string& text) {
  if (depth > kDeepestText) throw TextTooDeep();
  switch (value.type()) {
    case Type::kBool:
      text += value.as_bool() ? "true" : "false";
      return;
    case Type::kNumber:
      append_number(value.as_number(), text);
      return;
    case Type::kString:
      text += value.as_string();
      return;
    case Type::kVector: {
      text += '[';
      bool is_first = true;
      for (const Value& element : value.as_vector()) {
        if (!is_first) text += ", ";
        is_first = false;
        append_quoted(element, depth + 1, text);
      }
      text += ']';
      return;
    }
    case Type::kRange: {
      const Range& range = value.as_range();
      text += '[';
      append_number(range.begin, text);
      text += " : ";
      append_number(range.step, text);
      text += " : ";
      append_number(range.end, text);
      text += ']';
      return;
    }
    case Type::kFunction:
      ast::append_expression(*value.as_function().code->definition, text);
      return;
    case Type::kObject: {
      const Members& members = value.as_object();
      const std::span<const Value> keys = members.keys.as_vector();
      text += "{ ";
      for (std::size_t i = 0; i < keys.size(); ++i) {
        text += keys[i].as_string();
        text += " = ";
        append_quoted(members.values.as_vector()[i], depth + 1, text);
        text += "; ";
      }
      text += '}';
      return;
    }
    default:
      text += "undef";
  }
}

}  // namespace

void append_text(const Value& value, std::string& text) {
  append(value, 0, text);
}

void append_echo(const Value& value, std::string& text) {
  append_quoted(value, 0, text);
}

std::string to_text(const Value& value) {
  std::string text;
  append_text(value, text);
  return text;
}

std::string to_echo(const Value& value) {
  std::string text;
  append_echo(value, text);
  return text;
}

std::string expression_text(const ast::Expr& expression) {
  std::string text;
  ast::append_expression(expression, text);
  return text;
}

}  // namespace lamina::csg
