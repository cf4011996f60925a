#include "csg/eval/builtin/text_arguments.h"

#include <fmt/format.h>

#include "csg/eval/builtin/conversions.h"
#include "csg/eval/builtin/script.h"
#include "csg/eval/value/text.h"

namespace lamina::csg {

namespace {

// The size without an argument. An em is 100/72 of it.
constexpr double kDefaultSize = 10;
constexpr double kSizePerEm = 0.72;

double read_size(const TextArguments& arguments) {
  const Value& em = arguments.find("em");
  const Value& size = arguments.find("size");
  if (em.is_undef()) return number_or(size, kDefaultSize);
  if (!size.is_undef()) {
    arguments.warn(fmt::format("{}: \"size\" ignored when \"em\" is set",
                               arguments.caller));
  }
  return em.number_or_zero() * kSizePerEm;
}

}  // namespace

void check_types(const TextArguments& arguments) {
  const auto check = [&](std::string_view name, Type expected) {
    const Value& value = arguments.find(name);
    if (value.is_undef() || value.type() == expected) return;
    arguments.warn(fmt::format(
        "{}(..., {}={}) Invalid type: expected {}, found {}", arguments.caller,
        name, to_echo(value), type_name(expected), type_name(value.type())));
  };
  // In the order of OpenSCAD's messages.
  check("size", Type::kNumber);
  check("em", Type::kNumber);
  check("text", Type::kString);
  check("spacing", Type::kNumber);
  for (const char* name :
       {"font", "direction", "language", "script", "halign", "valign"}) {
    check(name, Type::kString);
  }
}

TextParams read_text(const TextArguments& arguments, std::string& script) {
  const auto read = [&](std::string_view name, std::string_view fallback) {
    return string_or(arguments.find(name), fallback);
  };
  const bool is_2021 = arguments.language == Language::k2021;
  TextParams params;
  params.size = read_size(arguments);
  params.text = read("text", "");
  params.spacing = number_or(arguments.find("spacing"), 1);
  params.font = read("font", "");
  script = text_script(params.text, read("script", ""));
  params.script = script;
  params.direction = text_direction(script, read("direction", ""));
  params.language = read("language", "en");
  params.halign = read("halign", is_2021 ? "left" : "default");
  params.valign = read("valign", is_2021 ? "baseline" : "default");
  params.rules = arguments.language;
  return params;
}

}  // namespace lamina::csg
