#include "serve/shop/offer.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "serve/shop/detail/json_number.h"
#include "serve/shop/order.h"

namespace lamina::shop {
namespace {

using Json = nlohmann::ordered_json;
using Value = Offer::Value;

// How far from its step a number may be [steps]: more than doubles lose on the
// way there, and less than anybody means.
constexpr double kStepTolerance = 1e-6;
// Where a range has more steps, doubles lose more than that.
constexpr double kMostSteps = 1e9;

constexpr std::size_t kMostFaults = 8;    // of a message
constexpr std::size_t kMostOptions = 20;  // of a message

std::optional<double> number_of(const Json& json, const char* name) {
  const auto found = json.find(name);
  if (found == json.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

std::string text_of(const Json& json, const char* name) {
  const auto found = json.find(name);
  return found == json.end() ? "" : found->get<std::string>();
}

std::optional<std::vector<double>> numbers_of(const Json& list) {
  std::vector<double> numbers;
  for (const Json& element : list) {
    if (!element.is_number()) return std::nullopt;
    numbers.push_back(element.get<double>());
  }
  return numbers;
}

// No value for what a parameter cannot have.
std::optional<Value> value_of(const Json& json) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number()) return json.get<double>();
  if (json.is_string()) return json.get<std::string>();
  if (json.is_array()) return numbers_of(json);
  return std::nullopt;
}

Json json_of(double number) { return detail::json_number<Json>(number); }

Json json_of(const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return json_of(*number);
  if (const auto* numbers = std::get_if<std::vector<double>>(&value)) {
    Json list = Json::array();
    for (const double number : *numbers) list.push_back(json_of(number));
    return list;
  }
  return std::visit([](const auto& v) { return Json(v); }, value);
}

// As a parameter set has it; {:} of fmt is the shortest text that reads back as
// the same double.
std::string set_text_of(const Value& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* truth = std::get_if<bool>(&value)) {
    return *truth ? "true" : "false";
  }
  if (const auto* number = std::get_if<double>(&value)) {
    return fmt::format("{}", *number);
  }
  std::string text;
  for (const double number : std::get<std::vector<double>>(value)) {
    text += fmt::format("{}{}", text.empty() ? "[" : ", ", number);
  }
  return text + "]";
}

const char* type_of(const Value& value) {
  constexpr const char* kTypes[] = {"boolean", "number", "string", "array"};
  return kTypes[value.index()];
}

std::string quoted(const Value& value) {
  const auto* text = std::get_if<std::string>(&value);
  return text == nullptr ? set_text_of(value) : "'" + short_name(*text) + "'";
}

}  // namespace

Offer::Offer(const Json& parameters) {
  for (const Json& json : parameters) {
    parameters_.push_back(read_parameter(json));
  }
}

bool Offer::can_count(const Range& range, std::optional<double> step) {
  const double farthest =
      std::max(std::abs(range.least), std::abs(range.greatest));
  return step && *step > 0 && farthest / *step <= kMostSteps;
}

// A greatest value alone makes 0 the least one, whatever the design's own is.
Offer::Range Offer::range_with(Range range, const Value& own) {
  std::vector<double> numbers;
  if (const auto* number = std::get_if<double>(&own)) numbers = {*number};
  if (const auto* list = std::get_if<std::vector<double>>(&own)) {
    numbers = *list;
  }
  for (const double number : numbers) {
    range.least = std::min(range.least, number);
    range.greatest = std::max(range.greatest, number);
  }
  return range;
}

Offer::Parameter Offer::read_parameter(const Json& json) {
  Parameter parameter{.name = json.at("name").get<std::string>(),
                      .caption = text_of(json, "caption"),
                      .group = text_of(json, "group"),
                      .own = value_of(json.at("initial")).value(),
                      .options = {},
                      .range = {},
                      .step = number_of(json, "step"),
                      .most_bytes = {}};
  const auto least = number_of(json, "min");
  const auto greatest = number_of(json, "max");
  if (least && greatest) {
    parameter.range = range_with({*least, *greatest}, parameter.own);
    if (!can_count(*parameter.range, parameter.step)) parameter.step.reset();
  }
  if (const auto most = number_of(json, "maxLength")) {
    parameter.most_bytes = static_cast<std::size_t>(*most);
  }
  for (const Json& option : json.value("options", Json::array())) {
    parameter.add_option(value_of(option.at("value")).value(),
                         text_of(option, "name"));
  }
  return parameter;
}

// Of options that a parameter set does not tell apart (1 and "1"), the first
// is what the design gets.
void Offer::Parameter::add_option(Value value, std::string title) {
  const std::string text = set_text_of(value);
  const bool is_there = std::ranges::any_of(options, [&](const Option& option) {
    return set_text_of(option.value) == text;
  });
  if (!is_there) options.push_back({std::move(value), std::move(title)});
}

bool Offer::Parameter::is_chosen(const Value& value) const {
  return std::ranges::find(options, value, &Option::value) != options.end();
}

bool Offer::Parameter::counts_steps() const {
  return std::holds_alternative<double>(own) && range && step;
}

// Whether all steps are exact multiples of the step, which has few bits.
bool Offer::Parameter::has_exact_steps() const {
  if (!counts_steps() || std::fmod(range->least, *step) != 0) return false;
  constexpr int kFewBits = 20;  // with those of kMostSteps no more than 53
  int exponent = 0;
  const double bits = std::ldexp(std::frexp(*step, &exponent), kFewBits);
  return std::trunc(bits) == bits;
}

bool Offer::Parameter::is_on_step(double number) const {
  if (!counts_steps()) return true;
  if (has_exact_steps()) return std::fmod(number, *step) == 0;
  return std::abs(std::remainder(number - range->least, *step)) <=
         kStepTolerance * *step;
}

std::string Offer::Parameter::fault_of_type(
    const std::optional<Value>& value) const {
  if (const auto* numbers = std::get_if<std::vector<double>>(&own)) {
    const auto* given =
        value ? std::get_if<std::vector<double>>(&*value) : nullptr;
    if (given != nullptr && given->size() == numbers->size()) return {};
    return fmt::format(" must be a list of {}",
                       counted(numbers->size(), "number"));
  }
  if (value && value->index() == own.index()) return {};
  if (std::holds_alternative<bool>(own)) return " must be true or false";
  return std::holds_alternative<double>(own) ? " must be a number"
                                             : " must be a text";
}

std::string Offer::Parameter::fault_of_number(double number) const {
  if (!range) return {};
  if (number < range->least) {
    return fmt::format(" must be at least {}", range->least);
  }
  if (number > range->greatest) {
    return fmt::format(" must be at most {}", range->greatest);
  }
  if (is_on_step(number)) return {};
  return fmt::format(" must be {} or a number of steps of {} above it",
                     range->least, *step);
}

std::string Offer::Parameter::fault_of(
    const std::optional<Value>& value) const {
  if (value == own) return {};
  if (!options.empty()) {
    if (value && is_chosen(*value)) return {};
    std::string list;
    for (std::size_t i = 0; i < std::min(options.size(), kMostOptions); ++i) {
      list += (i == 0 ? "" : ", ") + quoted(options[i].value);
    }
    return fmt::format(" must be one of {}{}", list,
                       options.size() > kMostOptions ? ", …" : "");
  }
  const std::string fault = fault_of_type(value);
  if (!fault.empty()) return fault;
  if (const auto* number = std::get_if<double>(&*value)) {
    return fault_of_number(*number);
  }
  if (const auto* numbers = std::get_if<std::vector<double>>(&*value)) {
    for (std::size_t i = 0; i < numbers->size(); ++i) {
      const std::string element = fault_of_number((*numbers)[i]);
      if (!element.empty()) return fmt::format("/{}{}", i, element);
    }
  }
  const auto* text = std::get_if<std::string>(&*value);
  if (text != nullptr && most_bytes && text->size() > *most_bytes) {
    return fmt::format(" must have at most {} of UTF-8",
                       counted(*most_bytes, "byte"));
  }
  return {};
}

Json Offer::Parameter::type_schema() const {
  std::set<std::string> types = {type_of(own)};
  for (const Option& option : options) types.insert(type_of(option.value));
  return types.size() == 1 ? Json(*types.begin()) : Json(types);
}

void Offer::Parameter::add_range(Json& json) const {
  if (!range) return;
  json["minimum"] = json_of(range->least);
  json["maximum"] = json_of(range->greatest);
  if (!has_exact_steps()) return;
  const Json steps = {{"multipleOf", json_of(*step)}};
  if (is_on_step(std::get<double>(own))) {
    json.update(steps);
  } else {
    json["anyOf"] = Json::array({{{"const", json_of(own)}}, steps});
  }
}

Json Offer::Parameter::schema() const {
  Json json = {{"type", type_schema()}};
  if (!caption.empty()) json["description"] = caption;
  json["default"] = json_of(own);
  if (const auto* numbers = std::get_if<std::vector<double>>(&own)) {
    Json items = {{"type", "number"}};
    add_range(items);
    json["items"] = std::move(items);
    json["minItems"] = numbers->size();
    json["maxItems"] = numbers->size();
  } else {
    add_range(json);
  }
  if (step) json["x-step"] = json_of(*step);
  for (const Option& option : options) {
    json["oneOf"].push_back(
        {{"const", json_of(option.value)}, {"title", option.title}});
  }
  if (most_bytes) {
    json["maxLength"] = *most_bytes;
    json["x-maxBytes"] = *most_bytes;
  }
  if (!group.empty()) json["x-group"] = group;
  return json;
}

Json Offer::schema(const std::string& title) const {
  Json properties = Json::object();
  for (const Parameter& parameter : parameters_) {
    properties[parameter.name] = parameter.schema();
  }
  return {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
          {"title", title},
          {"type", "object"},
          {"properties", std::move(properties)},
          {"additionalProperties", false}};
}

std::string Offer::unknown_name(const std::string& name,
                                Guesses& guesses) const {
  std::vector<std::string_view> names;
  for (const Parameter& parameter : parameters_) {
    names.push_back(parameter.name);
  }
  const std::string guess = guesses.did_you_mean(name, names);
  return fmt::format("values/{} is not a parameter of this design{}{}",
                     short_name(name), guess.empty() ? "" : ": ", guess);
}

ParameterSet Offer::check(std::string_view values) const {
  ParameterSet set;
  std::vector<std::string> faults;
  Guesses guesses;
  const Json json = Json::parse(values);
  for (const auto& [name, member] : json.items()) {
    if (faults.size() == kMostFaults) break;
    const auto parameter =
        std::ranges::find(parameters_, name, &Parameter::name);
    if (parameter == parameters_.end()) {
      faults.push_back(unknown_name(name, guesses));
      continue;
    }
    const auto value = value_of(member);
    const std::string fault = parameter->fault_of(value);
    if (!fault.empty()) {
      faults.push_back(fmt::format("values/{}{}", name, fault));
    } else if (*value != parameter->own) {
      set.push_back({name, set_text_of(*value)});
    }
  }
  if (faults.empty()) return set;
  throw OrderError(fmt::format("{}", fmt::join(faults, "; ")));
}

Json Offer::values_with_defaults(std::string_view values) const {
  const Json given = Json::parse(values);
  Json all = Json::object();
  for (const Parameter& parameter : parameters_) {
    const auto found = given.find(parameter.name);
    all[parameter.name] =
        found == given.end() ? json_of(parameter.own) : *found;
  }
  return all;
}

}  // namespace lamina::shop
