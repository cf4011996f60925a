#include "csg/eval/resolve/resolver.h"

#include <algorithm>

#include "csg/eval/builtin/functions.h"
#include "csg/eval/builtin/modules.h"
#include "csg/eval/resolve/expression.h"
#include "csg/eval/resolve/statement.h"
#include "parser/loader.h"

namespace lamina::csg {
std::uint32_t Activation::new_slot() {
  slot_count = std::max(slot_count, next_slot + 1);
  return next_slot++;
}

std::uint32_t Activation::count_hops(const Activation& outer) const {
  std::uint32_t hops = 0;
  for (const Activation* a = this; a != &outer; a = a->link) ++hops;
  return hops;
}

Resolver::Resolver(const Loader& loader, DynamicNames& names,
                   const EvaluateOptions& options)
    : loader_(loader), names_(names), options_(options) {}

Scope& Resolver::open_scope(Scope& parent, Activation& activation) {
  Scope& scope = scopes_.emplace_back();
  scope.parent = &parent;
  scope.home = parent.home;
  scope.activation = &activation;
  scope.unit = parent.unit;
  return scope;
}

Activation& Resolver::open_activation(Activation::Kind kind,
                                      Activation& around) {
  Activation& activation = activations_.emplace_back();
  activation.kind = kind;
  activation.lexical = &around;
  activation.link = around.is_statement_level() ? &around : around.link;
  activation.version = around.version;
  activation.depth = around.depth + 1;
  return activation;
}

NestedScope::NestedScope(Resolver& resolver, Scope*& current)
    : resolver_(resolver),
      current_(current),
      outer_(current),
      first_slot_(current->activation->next_slot) {
  current = &resolver.open_scope(*current, *current->activation);
}

NestedScope::~NestedScope() {
  resolver_.open_variables.leave(*current_);
  current_->activation->next_slot = first_slot_;
  current_ = outer_;
}

// --- Variables in sight ------------------------------------------------------

void OpenVariables::enter(Scope& scope) {
  for (const auto& [name, variable] : scope.variables) declare(name, *variable);
}

void OpenVariables::leave(Scope& scope) {
  for (const auto& [name, variable] : scope.variables) {
    innermost_[name] = variable->outer;
  }
}

void OpenVariables::declare(std::string_view name, Variable& variable) {
  Variable*& inner = innermost_[name];
  const bool is_again = inner != nullptr && inner->scope == variable.scope;
  variable.outer = is_again ? inner->outer : inner;
  inner = &variable;
}

namespace {
Variable* find_from(const Scope* home, std::string_view name) {
  for (; home != nullptr; home = home->next_home()) {
    const auto found = home->variables.find(name);
    if (found != home->variables.end()) return found->second;
  }
  return nullptr;
}
}  // namespace

Variable* OpenVariables::find(const Scope& scope, std::string_view name) const {
  const auto found = innermost_.find(name);
  return found != innermost_.end() && found->second != nullptr
             ? found->second
             : find_from(scope.home, name);
}

Variable* OpenVariables::next(const Variable& variable, std::string_view name) {
  if (variable.outer != nullptr) return variable.outer;
  const Scope& scope = *variable.scope;
  return find_from(scope.is_home() ? scope.next_home() : scope.home, name);
}

// --- Files ------------------------------------------------------------------

DeclaredUnit& Resolver::declared_unit(const ast::Program& program) {
  DeclaredUnit*& unit = unit_of_[&program];
  if (unit != nullptr) return *unit;
  unit = &units_.emplace_back();
  unit->number = counts_.units++;
  unit->program = &program;
  unit->source = program.source;
  if (unit->number > 0) unit->document = program.source;
  unit->activation.kind = Activation::Kind::kFile;
  unit->scope = &scopes_.emplace_back();
  unit->scope->activation = &unit->activation;
  unit->scope->unit = unit;
  unit->scope->home = unit->scope;
  declare(*unit->scope, program.statements);
  for (const ast::Use& use : program.uses) {
    const ast::Program* used = loader_.used_program(use);
    if (used != nullptr) unit->used.push_back(used);
  }
  return *unit;
}

void Resolver::resolve(const Unit& asked) {
  DeclaredUnit& unit = units_[asked.number];
  if (unit.is_resolved) return;
  unit.is_resolved = true;
  StatementResolver resolver(*this, *unit.scope);
  unit.body = resolver.body(unit.program->statements, unit.document != nullptr);
  unit.slot_count = unit.activation.slot_count;
}

namespace {

// A new function or module of the scope.
template <typename Named, typename Written>
Named& add_named(std::deque<Named>& all, const Written& written,
                 SourceRange range, Scope& scope) {
  Named& named = all.emplace_back();
  named.number = static_cast<std::uint32_t>(all.size() - 1);
  named.name = written.name;
  named.definition = &written;
  named.range = range;
  named.scope = &scope;
  named.unit = scope.unit;
  return named;
}

}  // namespace

Function& Resolver::new_function(const ast::FunctionDefinition& written,
                                 SourceRange range, Scope& scope) {
  return add_named(functions_, written, range, scope);
}

Module& Resolver::new_module(const ast::ModuleDefinition& written,
                             SourceRange range, Scope& scope) {
  return add_named(modules_, written, range, scope);
}

// Functions and modules are known in their whole scope; the last of a name
// wins.
void Resolver::declare(Scope& scope, ast::Statements statements) {
  for (const ast::Statement* statement : statements) {
    if (const auto* function =
            std::get_if<ast::FunctionDefinition>(&statement->node)) {
      Function& declared = new_function(*function, statement->range, scope);
      declared.parameters = make_parameters(function->parameters, 0);
      scope.functions[function->name] = &declared;
    } else if (const auto* module =
                   std::get_if<ast::ModuleDefinition>(&statement->node)) {
      Module& declared = new_module(*module, statement->range, scope);
      declared.parameters =
          make_parameters(module->parameters, Module::kChildrenSlot + 1);
      scope.modules[module->name] = &declared;
    }
  }
}

// --- Parameters -------------------------------------------------------------

void Resolver::declare_parameters(std::span<const Parameter> parameters,
                                  Scope& scope) {
  for (const Parameter& parameter : parameters) {
    if (parameter.target.kind != Target::Kind::kSlot) continue;
    Activation& activation = *scope.activation;
    auto* variable = make<Variable>();
    variable->slot = parameter.target.index;
    variable->scope = &scope;
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
  open_variables.enter(inside);
  ExpressionResolver resolver(*this, inside);
  callable.body = resolver.resolve(body, ExpressionResolver::Position::kTail);
  open_variables.leave(inside);
  callable.slot_count = inside.activation->slot_count;
}

void Resolver::resolve(const Function& asked) {
  Function& function = functions_[asked.number];
  resolve(*function.unit);
  Activation& activation =
      open_activation(Activation::Kind::kFunction, *function.scope->activation);
  activation.callable = &function;
  resolve_callable(function, function.definition->parameters,
                   *function.definition->body,
                   open_scope(*function.scope, activation), *function.scope);
}

void Resolver::resolve(const Module& asked) {
  Module& module = modules_[asked.number];
  resolve(*module.unit);
  module.is_resolved = true;
  Activation& activation =
      open_activation(Activation::Kind::kModule, *module.scope->activation);
  Scope& scope = open_scope(*module.scope, activation);
  scope.home = &scope;
  StatementResolver resolver(*this, scope);
  resolver.module(module);
  module.slot_count = activation.slot_count;
}

std::string Resolver::did_you_mean(Named kind, std::string_view name) {
  const auto known = hints_.find({kind, name});
  if (known != hints_.end()) return known->second;
  if (guesses_.are_over()) return "";
  std::vector<std::string_view> names;
  if (kind == Named::kModule) names = builtin_module_names();
  if (kind == Named::kFunction) names = builtin_function_names();
  const auto add = [&](const auto& table) {
    for (const auto& [own, code] : table) names.push_back(own);
  };
  for (const DeclaredUnit& unit : units_) {
    if (unit.scope == nullptr) continue;
    if (kind == Named::kVariable) add(unit.scope->variables);
    if (kind == Named::kFunction) add(unit.scope->functions);
    if (kind == Named::kModule) add(unit.scope->modules);
  }
  std::sort(names.begin(), names.end());
  return hints_[{kind, name}] = guesses_.did_you_mean(name, names);
}

}  // namespace lamina::csg
