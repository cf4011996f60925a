#include "serve/shop/detail/parameter.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "serve/shop/detail/json_number.h"

namespace lamina::shop::detail {
namespace {

using Json = nlohmann::ordered_json;

// How far from its step a number may be [steps]: more than doubles lose on the
// way there, and less than anybody means.
constexpr double kStepTolerance = 1e-6;
// Where a range has more steps, doubles lose more than that.
constexpr double kMostSteps = 1e9;

constexpr std::size_t kMostOptions = 20;  // of a message

std::optional<double> number_of(const Json& json, const char* name) {
  const auto found = json.find(name);
  if (found == json.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

std::optional<std::vector<double>> numbers_of(const Json& list) {
  std::vector<double> numbers;
  for (const Json& element : list) {
    if (!element.is_number()) return std::nullopt;
    numbers.push_back(element.get<double>());
  }
  return numbers;
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

std::optional<Value> value_of(const Json& json) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number()) return json.get<double>();
  if (json.is_string()) return json.get<std::string>();
  if (json.is_array()) return numbers_of(json);
  return std::nullopt;
}

Json json_of(const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) {
    return json_number<Json>(*number);
  }
  if (const auto* numbers = std::get_if<std::vector<double>>(&value)) {
    Json list = Json::array();
    for (const double number : *numbers) {
      list.push_back(json_number<Json>(number));
    }
    return list;
  }
  return std::visit([](const auto& v) { return Json(v); }, value);
}

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

Parameter::Parameter(const Json& json)
    : name_(json.at("name").get<std::string>()),
      caption_(json.value("caption", "")),
      group_(json.value("group", "")),
      own_(value_of(json.at("initial")).value()),
      step_(number_of(json, "step")) {
  read_range(json);
  if (const auto most = number_of(json, "maxLength")) {
    most_bytes_ = static_cast<std::size_t>(*most);
  }
  for (const Json& option : json.value("options", Json::array())) {
    add_option(value_of(option.at("value")).value(), option.value("name", ""));
  }
}

// A greatest value alone makes 0 the least one, whatever the design's own is.
// Steps that doubles do not tell apart do not count.
void Parameter::read_range(const Json& json) {
  const auto least = number_of(json, "min");
  const auto greatest = number_of(json, "max");
  if (!least || !greatest) return;
  range_ = {*least, *greatest};
  std::vector<double> own;
  if (const auto* number = std::get_if<double>(&own_)) own = {*number};
  if (const auto* list = std::get_if<std::vector<double>>(&own_)) own = *list;
  for (const double number : own) {
    range_->least = std::min(range_->least, number);
    range_->greatest = std::max(range_->greatest, number);
  }
  const double farthest =
      std::max(std::abs(range_->least), std::abs(range_->greatest));
  const bool can_count = step_ && *step_ > 0 && farthest / *step_ <= kMostSteps;
  if (!can_count) step_.reset();
}

// Of options that a parameter set does not tell apart (1 and "1"), the first
// is what the design gets.
void Parameter::add_option(Value value, std::string title) {
  const std::string text = set_text_of(value);
  const bool is_there = std::ranges::any_of(
      options_,
      [&](const Option& option) { return set_text_of(option.value) == text; });
  if (!is_there) options_.push_back({std::move(value), std::move(title)});
}

bool Parameter::is_chosen(const Value& value) const {
  return std::ranges::find(options_, value, &Option::value) != options_.end();
}

bool Parameter::counts_steps() const {
  return std::holds_alternative<double>(own_) && range_ && step_;
}

// Whether all steps are exact multiples of the step, which has few bits.
bool Parameter::has_exact_steps() const {
  if (!counts_steps() || std::fmod(range_->least, *step_) != 0) return false;
  constexpr int kFewBits = 20;  // with those of kMostSteps no more than 53
  int exponent = 0;
  const double bits = std::ldexp(std::frexp(*step_, &exponent), kFewBits);
  return std::trunc(bits) == bits;
}

bool Parameter::is_on_step(double number) const {
  if (!counts_steps()) return true;
  if (has_exact_steps()) return std::fmod(number, *step_) == 0;
  return std::abs(std::remainder(number - range_->least, *step_)) <=
         kStepTolerance * *step_;
}

std::string Parameter::fault_of_type(const std::optional<Value>& value) const {
  if (const auto* numbers = std::get_if<std::vector<double>>(&own_)) {
    const auto* given =
        value ? std::get_if<std::vector<double>>(&*value) : nullptr;
    if (given != nullptr && given->size() == numbers->size()) return {};
    return fmt::format(" must be a list of {}",
                       counted(numbers->size(), "number"));
  }
  if (value && value->index() == own_.index()) return {};
  if (std::holds_alternative<bool>(own_)) return " must be true or false";
  return std::holds_alternative<double>(own_) ? " must be a number"
                                              : " must be a text";
}

std::string Parameter::fault_of_number(double number) const {
  if (!range_) return {};
  if (number < range_->least) {
    return fmt::format(" must be at least {}", range_->least);
  }
  if (number > range_->greatest) {
    return fmt::format(" must be at most {}", range_->greatest);
  }
  if (is_on_step(number)) return {};
  return fmt::format(" must be {} or a number of steps of {} above it",
                     range_->least, *step_);
}

std::string Parameter::fault_of_numbers(
    const std::vector<double>& numbers) const {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::string fault = fault_of_number(numbers[i]);
    if (!fault.empty()) return fmt::format("/{}{}", i, fault);
  }
  return {};
}

std::string Parameter::fault_of_choice(
    const std::optional<Value>& value) const {
  if (value && is_chosen(*value)) return {};
  std::string list;
  for (std::size_t i = 0; i < std::min(options_.size(), kMostOptions); ++i) {
    list += (i == 0 ? "" : ", ") + quoted(options_[i].value);
  }
  return fmt::format(" must be one of {}{}", list,
                     options_.size() > kMostOptions ? ", …" : "");
}

std::string Parameter::fault_of(const std::optional<Value>& value) const {
  if (value == own_) return {};
  if (!options_.empty()) return fault_of_choice(value);
  std::string fault = fault_of_type(value);
  if (!fault.empty()) return fault;
  if (const auto* number = std::get_if<double>(&*value)) {
    return fault_of_number(*number);
  }
  if (const auto* numbers = std::get_if<std::vector<double>>(&*value)) {
    return fault_of_numbers(*numbers);
  }
  const auto* text = std::get_if<std::string>(&*value);
  const bool is_short =
      text == nullptr || text->size() <= most_bytes_.value_or(text->size());
  return is_short ? ""
                  : fmt::format(" must have at most {} of UTF-8",
                                counted(*most_bytes_, "byte"));
}

Json Parameter::type_schema() const {
  std::set<std::string> types = {type_of(own_)};
  for (const Option& option : options_) types.insert(type_of(option.value));
  return types.size() == 1 ? Json(*types.begin()) : Json(types);
}

void Parameter::add_range(Json& json) const {
  if (!range_) return;
  json["minimum"] = json_number<Json>(range_->least);
  json["maximum"] = json_number<Json>(range_->greatest);
  if (!has_exact_steps()) return;
  const Json steps = {{"multipleOf", json_number<Json>(*step_)}};
  if (is_on_step(std::get<double>(own_))) {
    json.update(steps);
  } else {
    json["anyOf"] = Json::array({{{"const", json_of(own_)}}, steps});
  }
}

Json Parameter::schema() const {
  Json json = {{"type", type_schema()}};
  if (!caption_.empty()) json["description"] = caption_;
  json["default"] = json_of(own_);
  if (const auto* numbers = std::get_if<std::vector<double>>(&own_)) {
    Json items = {{"type", "number"}};
    add_range(items);
    json["items"] = std::move(items);
    json["minItems"] = numbers->size();
    json["maxItems"] = numbers->size();
  } else {
    add_range(json);
  }
  if (step_) json["x-step"] = json_number<Json>(*step_);
  for (const Option& option : options_) {
    json["oneOf"].push_back(
        {{"const", json_of(option.value)}, {"title", option.title}});
  }
  if (most_bytes_) {
    json["maxLength"] = *most_bytes_;
    json["x-maxBytes"] = *most_bytes_;
  }
  if (!group_.empty()) json["x-group"] = group_;
  return json;
}

}  // namespace lamina::shop::detail
