// textmetrics() and fontmetrics() (see functions.h).

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "csg/eval/builtin/call.h"
#include "csg/eval/builtin/conversions.h"
#include "csg/eval/builtin/functions.h"
#include "csg/eval/builtin/script.h"
#include "csg/eval/value/object.h"
#include "csg/eval/value/text.h"
#include "csg/text_measurer.h"

namespace lamina::csg {

namespace {

// The size without an argument. An em is 100/72 of it.
constexpr double kDefaultSize = 10;
constexpr double kSizePerEm = 0.72;

// The arguments of one call by name. Owns the strings of its parameters.
class TextArguments {
 public:
  TextArguments(std::span<const std::string_view> names, std::size_t positional,
                const CallCode& code, Frame& frame)
      : names_(names),
        values_(run_named_arguments(names, positional, code, frame)),
        code_(code),
        frame_(frame) {
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

  // Valid as long as the arguments.
  TextParams params() {
    TextParams params;
    params.size = size();
    params.text = string_or((*this)["text"], "");
    params.spacing = number_or((*this)["spacing"], 1);
    params.font = string_or((*this)["font"], "");
    script_ = text_script(params.text, string_or((*this)["script"], ""));
    params.script = script_;
    params.direction =
        text_direction(script_, string_or((*this)["direction"], ""));
    params.language = string_or((*this)["language"], "en");
    params.halign = string_or((*this)["halign"], "left");
    params.valign = string_or((*this)["valign"], "baseline");
    return params;
  }

 private:
  // undef where the function has no such parameter.
  const Value& operator[](std::string_view name) const {
    static const Value kUndef;
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end()) return kUndef;
    return values_[static_cast<std::size_t>(found - names_.begin())];
  }

  void check(std::string_view name, Type expected) {
    const Value& value = (*this)[name];
    if (value.is_undef() || value.type() == expected) return;
    warn_in_file(code_, frame_,
                 "{}(..., {}={}) Invalid type: expected {}, found {}",
                 code_.name, name, to_echo(value), type_name(expected),
                 type_name(value.type()));
  }

  double size() {
    const Value& em = (*this)["em"];
    if (em.is_undef()) return number_or((*this)["size"], kDefaultSize);
    if (!(*this)["size"].is_undef()) {
      warn_in_file(code_, frame_, "{}: \"size\" ignored when \"em\" is set",
                   code_.name);
    }
    return em.number_or_zero() * kSizePerEm;
  }

  std::span<const std::string_view> names_;
  std::vector<Value> values_;
  const CallCode& code_;
  Frame& frame_;
  std::string script_;
};

Value to_value(Vec2 v) {
  const double numbers[] = {v.x, v.y};
  return Value::numbers(numbers);
}
Value to_value(double number) { return Value(number); }
Value to_value(const std::string& text) { return Value::string(text); }
Value to_value(Value value) { return value; }

// Sets members one after the other: name, value, name, value, …
template <typename T, typename... Rest>
void set_members(ObjectBuilder& builder, std::string_view name, T value,
                 Rest... rest) {
  builder.set(Value::string(name), to_value(std::move(value)));
  if constexpr (sizeof...(rest) > 0) set_members(builder, std::move(rest)...);
}
template <typename... Members>
Value make_object(Members... members) {
  ObjectBuilder builder;
  set_members(builder, std::move(members)...);
  return builder.finish();
}

// Asks the measurer for metrics by `measure`; no value where there is none.
template <typename Measure>
auto ask(const CallCode& code, Frame& frame, const Measure& measure)
    -> decltype(measure(std::declval<TextMeasurer&>(),
                        std::declval<std::vector<std::string>&>())) {
  TextMeasurer* measurer = frame.in.options().text_measurer;
  if (measurer == nullptr) return std::nullopt;
  std::vector<std::string> warnings;
  auto metrics = measure(*measurer, warnings);
  for (const std::string& warning : warnings) {
    warn_in_file(code, frame, "{}", warning);
  }
  return metrics;
}

}  // namespace

Value builtin_textmetrics(const CallCode& code, Frame& frame) {
  static constexpr std::string_view kNames[] = {
      "text",   "size",   "font",   "direction", "language",
      "script", "halign", "valign", "spacing",   "em"};
  TextArguments arguments(kNames, 3, code, frame);
  const TextParams params = arguments.params();
  const auto metrics = ask(code, frame, [&](auto& measurer, auto& warnings) {
    return measurer.measure_text(params, warnings);
  });
  if (!metrics) return Value();
  return make_object("position", metrics->position, "size", metrics->size,
                     "ascent", metrics->ascent, "descent", metrics->descent,
                     "offset", metrics->offset, "advance", metrics->advance);
}

Value builtin_fontmetrics(const CallCode& code, Frame& frame) {
  static constexpr std::string_view kNames[] = {"size", "font", "em"};
  TextArguments arguments(kNames, 3, code, frame);
  const TextParams params = arguments.params();
  const auto metrics = ask(code, frame, [&](auto& measurer, auto& warnings) {
    return measurer.measure_font(params, warnings);
  });
  if (!metrics) return Value();
  return make_object(
      "nominal",
      make_object("ascent", metrics->nominal_ascent, "descent",
                  metrics->nominal_descent),
      "max",
      make_object("ascent", metrics->max_ascent, "descent",
                  metrics->max_descent),
      "interline", metrics->interline, "font",
      make_object("family", metrics->family, "style", metrics->style));
}

}  // namespace lamina::csg
