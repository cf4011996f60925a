// Resolving names of variables (see expression.h).

#include <numbers>

#include "csg/eval/resolve/expression.h"
#include "csg/eval/resolve/prefixed_literal.h"
#include "csg/eval/run/runners.h"

namespace lamina::csg {

Variable* ExpressionResolver::declare(std::string_view name,
                                      bool is_statement_level) {
  auto* variable = resolver_.make<Variable>();
  variable->slot = scope_->activation->new_slot();
  variable->is_statement_level = is_statement_level;
  variable->scope = scope_;
  scope_->variables[name] = variable;
  if (!scope_->is_home()) resolver_.open_variables.declare(name, *variable);
  return variable;
}

Target ExpressionResolver::target(std::string_view name, Variable* variable) {
  if (is_dynamic_name(name)) {
    return {Target::Kind::kDynamic, resolver_.names().number_of(name), nullptr};
  }
  // Not null. NOLINTNEXTLINE(clang-analyzer-core.NullDereference)
  return {Target::Kind::kSlot, variable->slot, variable};
}

Target ExpressionResolver::declare_set(std::string_view name,
                                       bool is_statement_level,
                                       bool is_repeated) {
  Variable* variable = nullptr;
  if (!is_dynamic_name(name)) {
    variable = declare(name, is_statement_level);
    variable->is_set = true;
    variable->is_repeated = is_repeated;
  }
  return target(name, variable);
}

// Returns the index of a captured variable in the closures of `literal`.
// Literals between it and the variable's home capture the variable as well.
std::uint32_t ExpressionResolver::capture(Activation& literal,
                                          Variable& variable) {
  const auto known = literal.captured.find(&variable);
  if (known != literal.captured.end()) return known->second;
  FunctionLiteral::Capture source;
  if (literal.lexical == variable.scope->activation) {
    source.index = variable.slot;
  } else {
    source.from_closure = true;
    source.index = capture(*literal.lexical, variable);
  }
  auto& captures = literal.literal->captures;
  const auto index = static_cast<std::uint32_t>(captures.size());
  captures.push_back(source);
  literal.captured.emplace(&variable, index);
  return index;
}

namespace {

// The version of a literal, if any, through whose closures a variable comes.
const Activation* version_between(const Activation& here,
                                  const Variable& variable) {
  const Activation* version = here.version;
  return version != nullptr &&
                 version->depth > variable.scope->activation->depth
             ? version
             : nullptr;
}

// Whether code of a version can reach a variable. It cannot reach what the
// literal's closures have not captured; such a variable came later, or a nearer
// one certainly has a value.
bool is_within_reach(const Activation& here, const Variable& variable) {
  if (variable.is_statement_level) return true;
  const Activation* version = version_between(here, variable);
  return version == nullptr || version->captured.contains(&variable);
}

}  // namespace

const Expression* ExpressionResolver::load(Variable& variable,
                                           SourceRange range,
                                           bool* is_certain) {
  Activation& here = *scope_->activation;
  const Activation& home = *variable.scope->activation;
  auto* code = resolver_.make<VariableLoad>();
  code->range = range;
  *is_certain = variable.is_parameter;
  if (&home == &here) {
    *is_certain = !variable.may_be_unset;
    code->run = run_local;
    code->kind = Expression::Kind::kLocal;
    code->slot = variable.slot;
  } else if (variable.is_statement_level) {
    code->hops = here.count_hops(home);
    code->slot = variable.slot;
    code->run = code->hops == 1 ? run_outer : run_far_outer;
    if (code->hops == 1) code->kind = Expression::Kind::kOuter;
  } else {
    // By the time that a version is made, code may have run that boxes the
    // variable or does not: leave it as it is.
    const bool is_settled = version_between(here, variable) != nullptr;
    *is_certain = variable.is_set && !variable.may_be_unset && !is_settled;
    if (!is_settled && (!variable.is_set || variable.is_repeated)) {
      variable.is_boxed = true;
    }
    code->run = run_captured;
    code->slot = capture(here, variable);
  }
  return code;
}

const Expression* ExpressionResolver::variable(std::string_view name,
                                               SourceRange range,
                                               Unknown unknown) {
  if (is_dynamic_name(name)) {
    ++resolver_.dynamic_reads;
    auto* code = make<DynamicVariable>(run_dynamic, range);
    code->index = resolver_.names().number_of(name);
    code->name = name;
    code->is_silent = unknown == Unknown::kSilent;
    return code;
  }
  // Go from the innermost scope outwards, until one certainly has the variable.
  std::vector<const Expression*> candidates;
  bool is_certain = false;
  for (Variable* found = resolver_.open_variables.find(*scope_, name);
       found != nullptr && !is_certain;
       found = OpenVariables::next(*found, name)) {
    Variable& variable = *found;
    const bool is_here = variable.scope->activation == scope_->activation;
    if (is_here && !variable.is_set && !variable.may_be_unset) continue;
    if (!is_within_reach(*scope_->activation, variable)) continue;
    candidates.push_back(load(variable, range, &is_certain));
    if (!is_certain && !is_here && variable.is_statement_level) {
      variable.scope->resets.push_back(variable.slot);
    }
  }
  const Expression* otherwise = nullptr;
  if (!is_certain) {
    if (name == "PI") {
      otherwise = constant(Value(std::numbers::pi), range);
    } else if (is_prefixed_literal(name)) {
      otherwise = prefixed_literal(name, range);
    } else if (unknown == Unknown::kSilent) {
      otherwise = constant(Value(), range);
    } else {
      auto* code = make<UnknownVariable>(run_unknown_variable, range);
      code->name = name;
      otherwise = code;
    }
  }
  while (!candidates.empty()) {
    auto* code =
        static_cast<VariableLoad*>(const_cast<Expression*>(candidates.back()));
    code->otherwise = otherwise;
    otherwise = code;
    candidates.pop_back();
  }
  return otherwise;
}

const Expression* ExpressionResolver::prefixed_literal(std::string_view name,
                                                       SourceRange range) {
  const PrefixedLiteral literal = read_prefixed_literal(name);
  if (literal.warning.empty()) return constant(Value(literal.value), range);
  auto* code = make<InexactLiteral>(run_inexact_literal, range);
  code->value = literal.value;
  code->warning = resolver_.keep_text(literal.warning);
  return code;
}

}  // namespace lamina::csg
