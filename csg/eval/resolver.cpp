#include "csg/eval/resolver.h"

#include <algorithm>

#include "csg/eval/resolve_expression.h"
#include "csg/eval/resolve_statement.h"
#include "parser/loader.h"

namespace lamina::csg {

bool is_dynamic_name(std::string_view name) {
  return !name.empty() && name[0] == '$' && name != "$children";
}

std::uint32_t Activation::new_slot() {
  slot_count = std::max(slot_count, next_slot + 1);
  return next_slot++;
}

std::uint32_t Activation::count_hops(const Activation& outer) const {
  std::uint32_t hops = 0;
  for (const Activation* a = this; a != &outer; a = a->link) ++hops;
  return hops;
}

Resolver::Resolver(const Loader& loader, const EvaluateOptions& options)
    : loader_(loader), options_(options) {
  for (const char* name : {"$fn", "$fa", "$fs", "$t", "$preview", "$vpt",
                           "$vpr", "$vpd", "$vpf"}) {
    dynamic_index(name);
  }
}

std::string_view Resolver::keep_text(std::string_view text) {
  char* copy = static_cast<char*>(arena_.allocate(text.size(), 1));
  std::copy(text.begin(), text.end(), copy);
  return {copy, text.size()};
}

Scope& Resolver::open_scope(Scope& parent, Activation& activation) {
  scopes_.emplace_back();
  Scope& scope = scopes_.back();
  scope.parent = &parent;
  const bool has_definitions =
      !parent.functions.empty() || !parent.modules.empty();
  scope.definitions_outside =
      has_definitions ? &parent : parent.definitions_outside;
  scope.activation = &activation;
  scope.unit = parent.unit;
  return scope;
}

Activation& Resolver::open_activation(Activation::Kind kind,
                                      Activation& around) {
  activations_.emplace_back();
  Activation& activation = activations_.back();
  activation.kind = kind;
  activation.lexical = &around;
  activation.link = around.is_statement_level() ? &around : around.link;
  return activation;
}

// --- `$` variables ----------------------------------------------------------

std::uint32_t Resolver::dynamic_index(std::string_view name) {
  const auto [entry, is_new] = dynamic_index_.try_emplace(
      std::string(name), static_cast<std::uint32_t>(dynamic_index_.size()));
  return entry->second;
}

std::int64_t Resolver::find_dynamic(std::string_view name) const {
  const auto entry = dynamic_index_.find(std::string(name));
  return entry == dynamic_index_.end() ? -1 : std::int64_t{entry->second};
}

// --- Files ------------------------------------------------------------------

Unit& Resolver::unit_of(const ast::Program& program) {
  Unit*& unit = unit_of_[&program];
  if (unit != nullptr) return *unit;
  units_.emplace_back();
  unit = &units_.back();
  unit->program = &program;
  if (units_.size() > 1) unit->document = program.source;
  unit->activation.kind = Activation::Kind::kFile;
  scopes_.emplace_back();
  unit->scope = &scopes_.back();
  unit->scope->activation = &unit->activation;
  unit->scope->unit = unit;
  unit->scope->is_definition_scope = true;
  declare(*unit->scope, program.statements, *unit);
  for (const ast::Use& use : program.uses) unit->uses.push_back(&use);
  return *unit;
}

Unit* Resolver::used_unit(const ast::Use& use) {
  const ast::Program* program = loader_.used_program(use);
  return program == nullptr ? nullptr : &unit_of(*program);
}

void Resolver::resolve(Unit& unit) {
  if (unit.is_resolved) return;
  unit.is_resolved = true;
  StatementResolver resolver(*this, *unit.scope);
  unit.body = unit.document == nullptr
                  ? resolver.body(unit.program->statements)
                  : resolver.assignments_only(unit.program->statements);
}

// Functions and modules are known in their whole scope; the last of a name
// wins.
void Resolver::declare(Scope& scope, ast::Statements statements, Unit& unit) {
  for (const ast::Statement* statement : statements) {
    if (const auto* written =
            std::get_if<ast::FunctionDefinition>(&statement->node)) {
      functions_.emplace_back();
      Function& function = functions_.back();
      function.name = written->name;
      function.definition = written;
      function.range = statement->range;
      function.scope = &scope;
      function.unit = &unit;
      function.parameters = make_parameters(written->parameters, 0);
      scope.functions[written->name] = &function;
    } else if (const auto* module =
                   std::get_if<ast::ModuleDefinition>(&statement->node)) {
      modules_.emplace_back();
      Module& declared = modules_.back();
      declared.name = module->name;
      declared.definition = module;
      declared.range = statement->range;
      declared.scope = &scope;
      declared.unit = &unit;
      declared.children_slot = 0;
      declared.parameters = make_parameters(module->parameters, 1);
      scope.modules[module->name] = &declared;
    }
  }
}

Resolver::Callee Resolver::find_function(const Scope& scope,
                                         std::string_view name) {
  for (const Scope* s = &scope; s != nullptr; s = s->definitions_outside) {
    const auto found = s->functions.find(name);
    if (found != s->functions.end()) return {found->second, nullptr, false};
  }
  for (const ast::Use* use : scope.unit->uses) {
    const Unit* unit = used_unit(*use);
    if (unit == nullptr) continue;
    const auto found = unit->scope->functions.find(name);
    if (found != unit->scope->functions.end()) {
      return {found->second, nullptr, true};
    }
  }
  return {};
}

Resolver::Callee Resolver::find_module(const Scope& scope,
                                       std::string_view name) {
  for (const Scope* s = &scope; s != nullptr; s = s->definitions_outside) {
    const auto found = s->modules.find(name);
    if (found != s->modules.end()) return {nullptr, found->second, false};
  }
  for (const ast::Use* use : scope.unit->uses) {
    const Unit* unit = used_unit(*use);
    if (unit == nullptr) continue;
    const auto found = unit->scope->modules.find(name);
    if (found != unit->scope->modules.end()) {
      return {nullptr, found->second, true};
    }
  }
  return {};
}

// --- Parameters -------------------------------------------------------------

std::span<Parameter> Resolver::make_parameters(ast::Arguments written,
                                               std::uint32_t first_slot) {
  std::vector<Parameter> parameters;
  std::uint32_t slot = first_slot;
  for (const ast::Argument& argument : written) {
    Parameter parameter;
    parameter.name = argument.name;
    parameter.fallback_text = argument.value;
    parameter.has_silent_fallback =
        argument.value == nullptr || is_literal(*argument.value);
    const auto earlier = std::find_if(
        parameters.begin(), parameters.end(),
        [&](const Parameter& p) { return p.name == argument.name; });
    if (earlier != parameters.end()) {
      parameter.target = earlier->target;  // a name is one variable
    } else if (is_dynamic_name(argument.name)) {
      parameter.target = {Target::Kind::kDynamic, dynamic_index(argument.name),
                          nullptr};
    } else {
      parameter.target = {Target::Kind::kSlot, slot++, nullptr};
    }
    parameters.push_back(parameter);
  }
  const std::span<const Parameter> kept = keep(parameters);
  return {const_cast<Parameter*>(kept.data()), kept.size()};
}

void Resolver::declare_parameters(std::span<const Parameter> parameters,
                                  Scope& scope) {
  for (const Parameter& parameter : parameters) {
    if (parameter.target.kind != Target::Kind::kSlot) continue;
    Activation& activation = *scope.activation;
    auto* variable = make<Variable>();
    variable->slot = parameter.target.index;
    variable->activation = &activation;
    variable->is_set = true;
    variable->is_parameter = true;
    variable->is_statement_level = activation.is_statement_level();
    activation.next_slot = std::max(activation.next_slot, variable->slot + 1);
    activation.slot_count =
        std::max(activation.slot_count, activation.next_slot);
    scope.variables[parameter.name] = variable;
  }
}

// Fallbacks see what is around the definition, not the other parameters; but
// they run in the frame of the call.
void Resolver::resolve_fallbacks(std::span<Parameter> parameters, Scope& inside,
                                 Scope& outside) {
  Scope& scope = open_scope(outside, *inside.activation);
  ExpressionResolver resolver(*this, scope);
  for (Parameter& parameter : parameters) {
    if (parameter.fallback_text == nullptr) continue;
    parameter.fallback = resolver.resolve(*parameter.fallback_text);
  }
}

void Resolver::resolve_callable(Callable& callable, ast::Arguments parameters,
                                const ast::Expr& body, Scope& inside,
                                Scope& outside) {
  if (callable.parameters.empty()) {
    callable.parameters = make_parameters(parameters, 0);
  }
  declare_parameters(callable.parameters, inside);
  resolve_fallbacks(callable.parameters, inside, outside);
  ExpressionResolver resolver(*this, inside);
  callable.body = resolver.resolve(body, ExpressionResolver::Position::kTail);
  callable.slot_count = inside.activation->slot_count;
}

void Resolver::resolve(Function& function) {
  resolve(*function.unit);
  Activation& activation =
      open_activation(Activation::Kind::kFunction, *function.scope->activation);
  activation.callable = &function;
  resolve_callable(function, function.definition->parameters,
                   *function.definition->body,
                   open_scope(*function.scope, activation), *function.scope);
}

void Resolver::resolve(Module& module) {
  resolve(*module.unit);
  module.is_resolved = true;
  Activation& activation =
      open_activation(Activation::Kind::kModule, *module.scope->activation);
  Scope& scope = open_scope(*module.scope, activation);
  scope.is_definition_scope = true;
  StatementResolver resolver(*this, scope);
  resolver.module(module);
  module.slot_count = activation.slot_count;
}

// --- Arguments --------------------------------------------------------------

ArgumentPlan Resolver::plan(std::span<const Parameter> parameters,
                            std::size_t positional,
                            std::span<const WrittenArgument> arguments,
                            Surplus surplus) {
  ArgumentPlan plan;
  const bool warns = surplus == Surplus::kWarn;
  const auto find = [&](std::string_view name) {
    return std::find_if(parameters.begin(), parameters.end(),
                        [&](const Parameter& p) { return p.name == name; });
  };
  // OpenSCAD evaluates arguments in the order in which its hash table of names
  // gives them back; the same table gives the same order.
  std::unordered_map<std::string, std::uint32_t> resolved;
  std::size_t position = 0;
  bool has_too_many = false;
  for (std::uint32_t i = 0; i < arguments.size(); ++i) {
    const std::string_view name = arguments[i].name;
    if (!name.empty()) {
      const auto known = find(name);
      if (warns && name[0] != '$' &&
          (known == parameters.end() || known->is_extra)) {
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
  for (const auto& [name, index] : resolved) {
    BoundArgument bound;
    bound.written = index;
    const auto parameter = find(name);
    if (parameter != parameters.end()) {
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
  std::vector<std::string_view> names;
  for (const WrittenArgument& argument : arguments) {
    const std::string_view name = argument.name;
    if (name.empty() || name[0] == '$') continue;
    const bool is_known =
        std::any_of(parameters.begin(), parameters.end(),
                    [&](const Parameter& p) { return p.name == name; }) ||
        std::find(names.begin(), names.end(), name) != names.end();
    if (!is_known) names.push_back(name);
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
  activation.captured_variables = literal.activation->captured_variables;
  activation.is_version = true;
  version.activation = &activation;
  resolve_callable(version, literal.definition->parameters,
                   *literal.definition->body,
                   open_scope(*literal.scope, activation), *literal.scope);
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
