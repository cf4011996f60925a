#include "csg/eval/text.h"

#include <cmath>
#include <cstdio>

#include <double-conversion/double-conversion.h>

#include "csg/eval/code.h"

namespace lamina::csg {

namespace {

// The parameters with which OpenSCAD 2021.01 makes its converter.
const double_conversion::DoubleToStringConverter& converter() {
  using double_conversion::DoubleToStringConverter;
  static const DoubleToStringConverter instance(
      DoubleToStringConverter::UNIQUE_ZERO |
          DoubleToStringConverter::EMIT_POSITIVE_EXPONENT_SIGN,
      "inf", "nan", 'e', -6, 21, 5, 0);
  return instance;
}
constexpr int kPrecision = 6;

// Cuts zeros off the end of the fraction, and the point with them.
void append_trimmed(std::string_view digits, std::string& text) {
  const std::size_t point = digits.find('.');
  if (point == std::string_view::npos) {
    text += digits;
    return;
  }
  const std::size_t exponent = std::min(digits.find('e'), digits.size());
  std::size_t end = exponent;
  while (digits[end - 1] == '0') --end;
  if (end == point + 1) end = point;
  text += digits.substr(0, end);
  text += digits.substr(exponent);
}

// Whole numbers of up to six digits are most of all numbers and need no
// general conversion.
bool append_small_integer(double number, std::string& text) {
  if (!(std::fabs(number) < 1e6)) return false;
  const int integer = static_cast<int>(number);
  if (integer != number) return false;
  char digits[16];
  const int length = std::snprintf(digits, sizeof digits, "%d", integer);
  text.append(digits, static_cast<std::size_t>(length));
  return true;
}

}  // namespace

void append_number(double number, std::string& text) {
  if (append_small_integer(number, text)) return;
  if (!std::isfinite(number)) {
    text += std::isnan(number) ? "nan" : number < 0 ? "-inf" : "inf";
    return;
  }
  char buffer[128];
  double_conversion::StringBuilder builder(buffer, sizeof buffer);
  converter().ToPrecision(number, kPrecision, &builder);
  const int length = builder.position();
  builder.Finalize();
  append_trimmed({buffer, static_cast<std::size_t>(length)}, text);
}

void append_stream_number(double number, std::string& text) {
  if (!(number == 0 && std::signbit(number)) &&
      append_small_integer(number, text)) {
    return;
  }
  char digits[32];
  const int length = std::snprintf(digits, sizeof digits, "%g", number);
  text.append(digits, static_cast<std::size_t>(length));
}

void append_text(const Value& value, std::string& text) {
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
        append_echo(element, text);
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
      text += value.as_function().code->text();
      return;
    default:
      text += "undef";
  }
}

void append_echo(const Value& value, std::string& text) {
  if (value.is_string()) {
    text += '"';
    text += value.as_string();
    text += '"';
  } else {
    append_text(value, text);
  }
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
  return std::string(expression.range.text());
}

void append_quoted(std::string_view content, std::string& text) {
  text += '"';
  for (const char c : content) {
    switch (c) {
      case '\t':
        text += "\\t";
        break;
      case '\n':
        text += "\\n";
        break;
      case '\r':
        text += "\\r";
        break;
      case '"':
        text += "\\\"";
        break;
      case '\\':
        text += "\\\\";
        break;
      default:
        text += c;
    }
  }
  text += '"';
}

}  // namespace lamina::csg
