// textmetrics() and fontmetrics() (see functions.h).

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "csg/eval/builtin/call.h"
#include "csg/eval/builtin/functions.h"
#include "csg/eval/builtin/text_arguments.h"
#include "csg/eval/value/object.h"
#include "csg/text_measurer.h"

namespace lamina::csg {

namespace {

constexpr std::string_view kTextNames[] = {
    "text",   "size",   "font",   "direction", "language",
    "script", "halign", "valign", "spacing",   "em"};
constexpr std::string_view kFontNames[] = {"size", "font", "em"};

// The parameters of one call. Owns their strings.
class Call {
 public:
  Call(std::span<const std::string_view> names, const CallCode& code,
       Frame& frame)
      : values_(run_named_arguments(names, kPositional, code, frame)) {
    static const Value kUndef;
    TextArguments arguments;
    arguments.find = [&](std::string_view name) -> const Value& {
      const auto found = std::find(names.begin(), names.end(), name);
      if (found == names.end()) return kUndef;
      return values_[static_cast<std::size_t>(found - names.begin())];
    };
    arguments.warn = [&](const std::string& words) {
      warn_in_file(code, frame, "{}", words);
    };
    arguments.caller = code.name;
    arguments.language = frame.in.language();
    check_types(arguments);
    params_ = read_text(arguments, script_);
  }

  // Valid as long as the call.
  const TextParams& params() const { return params_; }

 private:
  static constexpr std::size_t kPositional = 3;

  std::vector<Value> values_;
  std::string script_;
  TextParams params_;
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
  const Call call(kTextNames, code, frame);
  const auto metrics = ask(code, frame, [&](auto& measurer, auto& warnings) {
    return measurer.measure_text(call.params(), warnings);
  });
  if (!metrics) return Value();
  return make_object("position", metrics->position, "size", metrics->size,
                     "ascent", metrics->ascent, "descent", metrics->descent,
                     "offset", metrics->offset, "advance", metrics->advance);
}

Value builtin_fontmetrics(const CallCode& code, Frame& frame) {
  const Call call(kFontNames, code, frame);
  const auto metrics = ask(code, frame, [&](auto& measurer, auto& warnings) {
    return measurer.measure_font(call.params(), warnings);
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
