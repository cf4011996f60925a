// Resolving parameters and the arguments that meet them (see resolver.h).

#include <algorithm>
#include <unordered_set>

#include "csg/eval/code/argument_plan.h"
#include "csg/eval/resolve/expression.h"
#include "csg/eval/resolve/resolver.h"

namespace lamina::csg {

std::span<Parameter> Resolver::make_parameters(ast::Arguments written,
                                               std::uint32_t first_slot) {
  std::vector<Parameter> parameters;
  for (const ast::Argument& argument : written) {
    Parameter parameter;
    parameter.name = argument.name;
    parameter.fallback_text = argument.value;
    parameter.has_silent_fallback =
        argument.value == nullptr || is_silent(*argument.value);
    parameters.push_back(parameter);
  }
  const ParameterIndex index(parameters);
  std::uint32_t slot = first_slot;
  for (Parameter& parameter : parameters) {
    const Parameter* first = index.find(parameter.name);
    if (first != &parameter) {
      parameter.target = first->target;  // a name is one variable
    } else if (is_dynamic_name(parameter.name)) {
      parameter.target = {Target::Kind::kDynamic,
                          names_.number_of(parameter.name), nullptr};
    } else {
      parameter.target = {Target::Kind::kSlot, slot++, nullptr};
    }
  }
  const std::span<const Parameter> kept = keep(parameters);
  return {const_cast<Parameter*>(kept.data()), kept.size()};
}

namespace {

// The names among the arguments that are not parameters.
std::vector<std::string_view> extra_names(
    std::span<const Parameter> parameters,
    std::span<const WrittenArgument> arguments) {
  const ParameterIndex index(parameters);
  std::vector<std::string_view> names;
  std::unordered_set<std::string_view> seen;
  for (const WrittenArgument& argument : arguments) {
    const std::string_view name = argument.name;
    if (name.empty() || name[0] == '$' || index.find(name) != nullptr) continue;
    if (seen.insert(name).second) names.push_back(name);
  }
  return names;
}

std::string joined(const std::vector<std::string_view>& names) {
  std::string text;
  for (const std::string_view name : names) {
    text += name;
    text += ',';
  }
  return text;
}

}  // namespace

std::span<Parameter> Resolver::extended_parameters(
    std::span<const Parameter> parameters,
    const std::vector<std::string_view>& names, std::uint32_t first_slot) {
  std::vector<Parameter> all(parameters.begin(), parameters.end());
  std::uint32_t slot = first_slot;
  for (const Parameter& parameter : all) {
    if (parameter.target.kind == Target::Kind::kSlot) {
      slot = std::max(slot, parameter.target.index + 1);
    }
  }
  for (const std::string_view name : names) {
    Parameter extra;
    extra.name = name;
    extra.is_extra = true;
    extra.target = {Target::Kind::kSlot, slot++, nullptr};
    all.push_back(extra);
  }
  const std::span<const Parameter> kept = keep(all);
  return {const_cast<Parameter*>(kept.data()), kept.size()};
}

const Function& Resolver::with_extras(
    const Function& function, std::span<const WrittenArgument> arguments) {
  const std::vector<std::string_view> names =
      extra_names(function.parameters, arguments);
  if (names.empty()) return function;
  const Function*& known = extra_functions_[{&function, joined(names)}];
  if (known == nullptr) {
    Function& version =
        new_function(*function.definition, function.range, *function.scope);
    version.parameters = extended_parameters(function.parameters, names, 0);
    known = &version;
  }
  return *known;
}

const Module& Resolver::with_extras(
    const Module& module, std::span<const WrittenArgument> arguments) {
  const std::vector<std::string_view> names =
      extra_names(module.parameters, arguments);
  if (names.empty()) return module;
  const Module*& known = extra_modules_[{&module, joined(names)}];
  if (known == nullptr) {
    Module& version =
        new_module(*module.definition, module.range, *module.scope);
    version.parameters = extended_parameters(module.parameters, names,
                                             Module::kChildrenSlot + 1);
    known = &version;
  }
  return *known;
}

// Closures of the literal exist: its versions can use only what these captured.
const FunctionLiteral& Resolver::with_extras(
    const FunctionLiteral& literal,
    std::span<const WrittenArgument> arguments) {
  const std::vector<std::string_view> names =
      extra_names(literal.parameters, arguments);
  if (names.empty()) return literal;
  const FunctionLiteral*& known = extra_literals_[{&literal, joined(names)}];
  if (known != nullptr) return *known;
  FunctionLiteral& version = new_literal();
  version = literal;
  version.parameters = extended_parameters(literal.parameters, names, 0);
  Activation& activation =
      open_activation(Activation::Kind::kLiteral, *literal.scope->activation);
  activation.callable = &version;
  activation.literal = &version;
  activation.captured = literal.activation->captured;
  activation.version = &activation;
  version.activation = &activation;
  // Enter the scopes around the literal once more.
  std::vector<Scope*> around;
  for (Scope* s = literal.scope; !s->is_home(); s = s->parent) {
    around.push_back(s);
  }
  for (auto s = around.rbegin(); s != around.rend(); ++s) {
    open_variables.enter(**s);
  }
  resolve_callable(version, literal.definition->parameters,
                   *literal.definition->body,
                   open_scope(*literal.scope, activation), *literal.scope);
  for (Scope* s : around) open_variables.leave(*s);
  known = &version;
  return version;
}

const LiteralCall& Resolver::plan_for(const CallCode& call,
                                      const FunctionLiteral& literal) {
  const auto [entry, is_new] = literal_calls_.try_emplace({&call, &literal});
  LiteralCall& planned = entry->second;
  if (is_new) {
    planned.literal = &with_extras(literal, call.arguments);
    planned.plan = plan_arguments(planned.literal->parameters,
                                  literal.definition->parameters.size(),
                                  call.arguments, names_, options_.language);
  }
  return planned;
}

}  // namespace lamina::csg
