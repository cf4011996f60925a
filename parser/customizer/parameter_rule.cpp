// The rules of parameters as OpenSCAD 2026 reads and exports them.

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "parser/customizer/customizer.h"
#include "parser/tree_facts.h"

namespace lamina {
namespace {

using Json = nlohmann::json;
using Choice = ParameterRule::Choice;
using ast::number_of;
using ast::numbers_of;

std::optional<std::variant<double, std::string>> read_choice(
    const ast::Expr& expr) {
  if (const auto number = number_of(expr)) return *number;
  if (const auto* text = std::get_if<ast::String>(&expr.node)) {
    return std::string(text->value);
  }
  return std::nullopt;
}

std::string label_of(const std::variant<double, std::string>& value) {
  const auto* number = std::get_if<double>(&value);
  return number != nullptr ? fmt::format("{:g}", *number)
                           : std::get<std::string>(value);
}

// A list of values, each alone or with its label; nothing where it is none. One
// number alone is a greatest value.
std::vector<Choice> read_choices(const ast::Expr& comment) {
  std::vector<Choice> choices;
  const auto* list = std::get_if<ast::Vector>(&comment.node);
  if (list == nullptr) return {};
  const auto elements = list->elements;
  if (elements.size() == 1 && number_of(*elements[0])) return {};
  for (const ast::Expr* element : elements) {
    const auto* pair = std::get_if<ast::Vector>(&element->node);
    if (pair != nullptr && pair->elements.size() != 2) return {};
    // Elements are. NOLINTNEXTLINE(clang-analyzer-core.NonNullParamChecker)
    const auto value = read_choice(pair ? *pair->elements[0] : *element);
    const auto label = pair ? read_choice(*pair->elements[1]) : value;
    if (!value || !label) return {};
    choices.push_back({*value, label_of(*label)});
  }
  return choices;
}

void read_limits(const ast::Expr& comment, std::span<const double> values,
                 ParameterRule& rule) {
  if (const auto step = number_of(comment)) rule.step = *step;
  if (const auto* range = std::get_if<ast::Range>(&comment.node)) {
    rule.least = number_of(*range->begin);
    rule.greatest = number_of(*range->end);
    if (range->step != nullptr) rule.step = number_of(*range->step);
  }
  if (const auto* list = std::get_if<ast::Vector>(&comment.node)) {
    if (list->elements.size() == 1) {
      rule.greatest = number_of(*list->elements[0]);
    }
  }
  for (const double value : values) {
    if (rule.least) rule.least = std::min(*rule.least, value);
    if (rule.greatest) rule.greatest = std::max(*rule.greatest, value);
  }
}

// The default is the first choice where the list lacks it.
void add_own_value(const std::variant<double, std::string>& own,
                   std::vector<Choice>& choices) {
  const bool is_there =
      std::any_of(choices.begin(), choices.end(),
                  [&](const Choice& choice) { return choice.value == own; });
  if (!is_there) choices.insert(choices.begin(), {own, label_of(own)});
}

Json to_json(const std::variant<double, std::string>& value) {
  return std::visit([](const auto& v) { return Json(v); }, value);
}

void add_limits(const ParameterRule& rule, bool shows_step, Json& json) {
  if (rule.greatest) {
    json["min"] = rule.least.value_or(0);
    json["max"] = *rule.greatest;
  }
  if (rule.greatest || shows_step) json["step"] = rule.step.value_or(1);
}

// The type, the value and what the rule says of it.
void add_value(const ast::Expr& value, const ParameterRule& rule, Json& json) {
  if (const auto* truth = std::get_if<ast::Bool>(&value.node)) {
    json["type"] = "boolean";
    json["initial"] = truth->value;
  } else if (const auto own = read_choice(value)) {
    json["type"] = own->index() == 0 ? "number" : "string";
    json["initial"] = to_json(*own);
    for (const Choice& choice : rule.choices) {
      json["options"].push_back(
          {{"name", choice.label}, {"value", to_json(choice.value)}});
    }
    if (rule.most_bytes) json["maxLength"] = *rule.most_bytes;
    if (own->index() == 0 && rule.choices.empty()) {
      add_limits(rule, true, json);
    }
  } else {
    json["type"] = "number";
    json["initial"] = *numbers_of(value);
    add_limits(rule, false, json);
  }
}

}  // namespace

double ParameterRule::nearest(double number) const {
  number = std::max(number, least.value_or(number));
  return std::min(number, greatest.value_or(number));
}

bool keeps_rule(const ast::Expr& value, const ParameterRule& rule) {
  if (!ast::is_literal(value)) return true;
  if (!rule.choices.empty()) {
    const auto chosen = read_choice(value);
    return std::any_of(
        rule.choices.begin(), rule.choices.end(),
        [&](const Choice& choice) { return choice.value == chosen; });
  }
  const auto is_within = [&](double number) {
    return rule.nearest(number) == number;
  };
  if (const auto number = number_of(value)) return is_within(*number);
  if (const auto numbers = numbers_of(value)) {
    return std::all_of(numbers->begin(), numbers->end(), is_within);
  }
  const auto* text = std::get_if<ast::String>(&value.node);
  return text == nullptr ||
         text->value.size() <= rule.most_bytes.value_or(text->value.size());
}

std::optional<ParameterRule> Customizer::rule_of(
    const ast::Statement& assignment) const {
  if (!is_parameter(assignment)) return std::nullopt;
  const std::string* group = group_of(assignment);
  if (group != nullptr && trim(*group) == "Hidden") return std::nullopt;
  const auto& value = *std::get<ast::Assignment>(assignment.node).value;
  const auto own = read_choice(value);
  const auto numbers = numbers_of(value);
  const bool is_vector = numbers && !numbers->empty() && numbers->size() <= 4;
  ParameterRule rule;
  if (std::holds_alternative<ast::Bool>(value.node)) return rule;
  if (!own && !is_vector) return std::nullopt;
  Arena arena;
  const ast::Expr* comment = values_of(assignment, arena);
  if (comment == nullptr) return rule;
  if (own) rule.choices = read_choices(*comment);
  if (!rule.choices.empty()) {
    add_own_value(*own, rule.choices);
  } else if (own && own->index() == 1) {
    if (const auto size = number_of(*comment); size && *size >= 0) {
      const auto own_size = std::get<std::string>(*own).size();
      rule.most_bytes = std::max(static_cast<std::size_t>(*size), own_size);
    }
  } else if (own) {
    read_limits(*comment, {{std::get<double>(*own)}}, rule);
  } else {
    read_limits(*comment, *numbers, rule);
  }
  return rule;
}

std::string parameters_json(const ast::Program& program,
                            const std::string& title) {
  const Customizer customizer = Customizer::read(program);
  Json file = {{"title", title}};
  for (const std::size_t place :
       ast::assignments_that_count(program.statements)) {
    const ast::Statement& statement = *program.statements[place];
    const auto rule = customizer.rule_of(statement);
    if (!rule) continue;
    const auto& assignment = std::get<ast::Assignment>(statement.node);
    const ParameterComment comment = customizer.comment_of(statement);
    Json& json = file["parameters"].emplace_back(Json::object());
    json["name"] = assignment.name;
    if (!comment.description.empty()) json["caption"] = comment.description;
    json["group"] = comment.has_group ? trim(comment.group) : "Parameters";
    add_value(*assignment.value, *rule, json);
  }
  return file.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lamina
