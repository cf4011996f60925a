// Resolving parameters and the arguments that meet them (see resolver.h).

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "csg/eval/resolve/expression.h"
#include "csg/eval/resolve/resolver.h"

namespace lamina::csg {

namespace {

// Parameters by name; of several with one name, the first.
class ParameterIndex {
 public:
  explicit ParameterIndex(std::span<const Parameter> parameters)
      : parameters_(parameters) {
    if (parameters.size() <= kFew) return;
    for (const Parameter& p : parameters) table_.try_emplace(p.name, &p);
  }

  const Parameter* find(std::string_view name) const {
    if (parameters_.size() > kFew) {
      const auto found = table_.find(name);
      return found == table_.end() ? nullptr : found->second;
    }
    for (const Parameter& p : parameters_) {
      if (p.name == name) return &p;
    }
    return nullptr;
  }

 private:
  // Comparing so many names costs less than a table.
  static constexpr std::size_t kFew = 12;
  std::span<const Parameter> parameters_;
  std::unordered_map<std::string_view, const Parameter*> table_;
};

}  // namespace

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
      parameter.target = {Target::Kind::kDynamic, dynamic_index(parameter.name),
                          nullptr};
    } else {
      parameter.target = {Target::Kind::kSlot, slot++, nullptr};
    }
  }
  const std::span<const Parameter> kept = keep(parameters);
  return {const_cast<Parameter*>(kept.data()), kept.size()};
}

ArgumentPlan Resolver::plan(std::span<const Parameter> parameters,
                            std::size_t positional,
                            std::span<const WrittenArgument> arguments,
                            Surplus surplus) {
  ArgumentPlan plan;
  const bool warns = surplus == Surplus::kWarn;
  const ParameterIndex index(parameters);
  // OpenSCAD evaluates arguments in the order in which its hash table of names
  // gives them back; the same table gives the same order.
  std::unordered_map<std::string, std::uint32_t> resolved;
  std::size_t position = 0;
  bool has_too_many = false;
  for (std::uint32_t i = 0; i < arguments.size(); ++i) {
    const std::string_view name = arguments[i].name;
    if (!name.empty()) {
      const Parameter* known = index.find(name);
      if (warns && name[0] != '$' && (known == nullptr || known->is_extra)) {
        plan.warnings.push_back("variable " + std::string(name) +
                                " not specified as parameter");
      }
      if (resolved.contains(std::string(name))) {
        plan.warnings.push_back("argument " + std::string(name) +
                                " supplied more than once");
      }
      resolved[std::string(name)] = i;
    } else if (position < positional) {
      resolved[std::string(parameters[position++].name)] = i;
    } else if (warns && !has_too_many) {
      plan.warnings.emplace_back("Too many unnamed arguments supplied");
      has_too_many = true;
    }
  }
  for (const auto& [name, written] : resolved) {
    BoundArgument bound;
    bound.written = written;
    const Parameter* parameter = index.find(name);
    if (parameter != nullptr) {
      bound.target = parameter->target;
    } else if (is_dynamic_name(name)) {
      bound.target = {Target::Kind::kDynamic, dynamic_index(name), nullptr};
    }
    plan.bound.push_back(bound);
  }
  for (std::uint32_t i = 0; i < parameters.size(); ++i) {
    if (!parameters[i].is_extra &&
        (!resolved.contains(std::string(parameters[i].name)) ||
         !parameters[i].has_silent_fallback)) {
      plan.defaults.push_back(i);
    }
  }
  return plan;
}

namespace {

// The names among the arguments that are no parameters.
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

Function& Resolver::with_extras(Function& function,
                                std::span<const WrittenArgument> arguments) {
  const std::vector<std::string_view> names =
      extra_names(function.parameters, arguments);
  if (names.empty()) return function;
  Function*& extended = extra_functions_[{&function, joined(names)}];
  if (extended == nullptr) {
    extended = &functions_.emplace_back();
    extended->name = function.name;
    extended->definition = function.definition;
    extended->range = function.range;
    extended->scope = function.scope;
    extended->unit = function.unit;
    extended->parameters = extended_parameters(function.parameters, names, 0);
  }
  return *extended;
}

Module& Resolver::with_extras(Module& module,
                              std::span<const WrittenArgument> arguments) {
  const std::vector<std::string_view> names =
      extra_names(module.parameters, arguments);
  if (names.empty()) return module;
  Module*& extended = extra_modules_[{&module, joined(names)}];
  if (extended == nullptr) {
    extended = &modules_.emplace_back();
    extended->name = module.name;
    extended->definition = module.definition;
    extended->range = module.range;
    extended->scope = module.scope;
    extended->unit = module.unit;
    extended->children_slot = module.children_slot;
    extended->parameters = extended_parameters(module.parameters, names, 1);
  }
  return *extended;
}

// The literal's closures are made: its versions know what these captured.
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
  // Go back to where the literal is written.
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
    planned.plan = plan(planned.literal->parameters,
                        literal.definition->parameters.size(), call.arguments);
  }
  return planned;
}

}  // namespace lamina::csg
