#include "random_programs.h"

#include <algorithm>
#include <initializer_list>
#include <string_view>

namespace lamina {

namespace {

std::string concat(std::initializer_list<std::string_view> parts) {
  std::string text;
  for (const std::string_view part : parts) text += part;
  return text;
}

}  // namespace

int RandomPrograms::below(int count) {
  return static_cast<int>(random_() % static_cast<unsigned>(count));
}

std::string RandomPrograms::blank() {
  return any(
      {"", "", "", " ", "\t", "/*c*/", " // x\n", "\n", "\r\n", "\xc2\xa0"});
}

std::string RandomPrograms::name() {
  return any({"a", "b", "$fn", "x1", "2d", "_", "begin", "fore", "lets"});
}

std::string RandomPrograms::string() {
  std::string text = "\"";
  for (int i = below(4); i > 0; --i) {
    text += any({"a", "b c", "\\n", "\\t", "\\\"", "\\\\", "\\x41", "\\x7f",
                 "\\u20ac", "\\U01f600", "\\q", "\\x00", "é", "\\ud800", "//",
                 "/*", "\\xff", "\\r"});
  }
  return text + "\"";
}

std::string RandomPrograms::literal() {
  switch (below(4)) {
    case 0:
      return any({"0", "1", ".5", "1.", "1e3", "2.5e-2", "1E+2", "007", "1.e1",
                  "123456789", "0.1234567", "1e-7"});
    case 1:
      return string();
    case 2:
      return any({"true", "false", "undef", "[]", "[,]"});
    default:
      return name();
  }
}

std::string RandomPrograms::arguments(int depth) {
  std::string text = any({"", "", ","});
  const int count = below(4);
  if (count == 0) return "";
  for (int i = 0; i < count; ++i) {
    if (i > 0) text += any({",", ",,"});
    if (chance(40)) text += concat({name(), blank(), "=", blank()});
    text += expression(depth - 1);
  }
  return text;
}

std::string RandomPrograms::parameters(int depth) {
  std::string text;
  const int count = below(3);
  for (int i = 0; i < count; ++i) {
    if (i > 0) text += ',';
    text += name();
    if (chance(50)) text += concat({"=", expression(depth - 1)});
  }
  return text + any({"", "", ","});
}

std::string RandomPrograms::operand(int depth) {
  if (depth <= 0) return literal();
  switch (below(12)) {
    case 0:
    case 1:
    case 2:
    case 3:
      // A blank keeps `/` and `*` from making a comment with what follows.
      return concat({operand(depth - 1), " ",
                     any({"+", "-", "*", "/", "%", "^", "<", "<=", ">",
                          ">=", "==", "!=", "&&", "||"}),
                     " ", blank(), operand(depth - 1)});
    case 4:
      return concat({any({"-", "+", "!"}), blank(), operand(depth - 1)});
    case 5:
      return concat({"(", blank(), expression(depth - 1), blank(), ")"});
    case 6:
      return concat({operand(depth - 1), "[", expression(depth - 1), "]"});
    case 7:
      return concat({name(), "(", arguments(depth), ")"});
    case 8:
      return concat(
          {"(", expression(depth - 1), ")(", arguments(depth), ").y"});
    case 9:
      return concat({"[", expression(depth - 1), ":", expression(depth - 1),
                     chance(50) ? concat({":", expression(depth - 1)}) : "",
                     "]"});
    default:
      return vector(depth);
  }
}

std::string RandomPrograms::vector(int depth) {
  std::string text = "[";
  for (int i = below(3); i >= 0; --i) {
    text += chance(40) ? elements(depth - 1) : expression(depth - 1);
    text += i > 0 ? any({",", ",,"}) : any({"", "", ","});
  }
  return text + "]";
}

std::string RandomPrograms::elements_or_expression(int depth) {
  if (depth <= 0 || chance(60)) return expression(depth);
  return chance(60) ? elements(depth) : concat({"(", elements(depth), ")"});
}

std::string RandomPrograms::elements(int depth) {
  if (depth <= 0) return concat({"each ", literal()});
  const std::string body = elements_or_expression(depth - 1);
  switch (below(6)) {
    case 0:
      return concat({"let(", arguments(depth), ")", elements(depth - 1)});
    case 1:
      return concat({"each ", body});
    case 2:
      return concat({"for(", arguments(depth), ")", body});
    case 3:
      return concat({"for(", arguments(depth), ";", expression(depth - 1), ";",
                     arguments(depth), ")", body});
    case 4:
      return concat({"if(", expression(depth - 1), ")", body});
    default:
      return concat({"if(", expression(depth - 1), ")(", expression(depth - 1),
                     ") else ", body});
  }
}

std::string RandomPrograms::expression(int depth) {
  if (depth <= 0) return literal();
  const std::string body = expression(depth - 1);
  switch (below(12)) {
    case 0:
      return concat(
          {operand(depth - 1), "?", expression(depth - 1), ":", body});
    case 1:
      return concat({"let(", arguments(depth), ") ", body});
    case 2:
      return concat(
          {"assert(", arguments(depth), ") ", chance(50) ? body : ""});
    case 3:
      return concat({"echo(", arguments(depth), ") ", chance(50) ? body : ""});
    case 4:
      return concat({"function(", parameters(depth), ") ", body});
    default:
      return operand(depth);
  }
}

std::string RandomPrograms::child(int depth) {
  if (depth <= 0 || chance(20)) return ";";
  if (chance(60)) return instantiation(depth - 1);
  std::string text = "{";
  for (int i = below(3); i > 0; --i) {
    text += chance(50) ? child(depth - 1)
                       : concat({name(), "=", expression(1), ";"});
  }
  return text + "}";
}

std::string RandomPrograms::instantiation(int depth) {
  std::string text;
  for (int i = std::max(0, below(5) - 2); i > 0; --i) {
    text += any({"#", "%", "!", "*"});
  }
  if (chance(30)) {
    text += concat({"if(", expression(1), ")", blank(), child(depth - 1)});
    if (chance(50)) text += concat({" else ", child(depth - 1)});
    return text;
  }
  text += any({"a", "for", "let", "assert", "echo", "each", "cube", "union"});
  return concat({text, blank(), "(", arguments(1), ")", child(depth - 1)});
}

std::string RandomPrograms::statement(int depth) {
  if (depth <= 0) return ";";
  switch (below(6)) {
    case 0:
      return concat({"{", statement(depth - 1), statement(depth - 1), "}"});
    case 1:
      return concat(
          {"function ", name(), "(", parameters(2), ")=", expression(3), ";"});
    case 2:
      return concat(
          {"module ", name(), "(", parameters(2), ")", statement(depth - 1)});
    case 3:
      return instantiation(depth);
    default:
      return concat({name(), blank(), "=", expression(3), ";"});
  }
}

std::string RandomPrograms::program(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    const std::string number = std::to_string(i);
    switch (below(3)) {
      case 0:
        text += concat({"function f", number, "(", parameters(2),
                        ") =", blank(), expression(4), ";"});
        break;
      case 1:
        text += concat(
            {"module m", number, "(", parameters(2), ") ", instantiation(4)});
        break;
      default:
        text += concat({"module n", number, "() {", statement(3), statement(3),
                        statement(3), "}"});
    }
    text += any({"\n", "", " ", "\r\n"});
  }
  return text;
}

std::string RandomPrograms::damage(std::string program) {
  const auto place =
      static_cast<std::size_t>(below(static_cast<int>(program.size())));
  const std::string token =
      any({";",  "(",    ")",    "[",        "]",      "{",   "}",   ",",
           "=",  ":",    "?",    ".",        "+",      "-",   "*",   "%",
           "^",  "!",    ">",    "==",       "a",      "1",   "let", "for",
           "if", "else", "each", "function", "module", "true"});
  program.replace(place, static_cast<std::size_t>(below(3)),
                  chance(30) ? std::string() : concat({" ", token, " "}));
  return program;
}

}  // namespace lamina
