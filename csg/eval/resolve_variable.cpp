// Resolving names of variables (see resolve_expression.h).

#include <algorithm>
#include <numbers>

#include "csg/eval/literals.h"
#include "csg/eval/resolve_expression.h"
#include "csg/eval/run_expression.h"

namespace lamina::csg {

Variable* ExpressionResolver::declare(std::string_view name,
                                      bool is_statement_level) {
  auto* variable = resolver_.make<Variable>();
  variable->slot = scope_->activation->new_slot();
  variable->is_statement_level = is_statement_level;
  variable->activation = scope_->activation;
  scope_->variables[name] = variable;
  return variable;
}

Target ExpressionResolver::target(std::string_view name, Variable* variable) {
  if (is_dynamic_name(name)) {
    return {Target::Kind::kDynamic, resolver_.dynamic_index(name), nullptr};
  }
  return {Target::Kind::kSlot, variable->slot, variable};
}

// Index of a captured variable in the closures of `literal`; literals between
// it and the variable's home pass it on.
std::uint32_t ExpressionResolver::capture(Activation& literal,
                                          Variable& variable) {
  FunctionLiteral::Capture source;
  if (literal.lexical == variable.activation) {
    source.index = variable.slot;
  } else {
    source.from_closure = true;
    source.index = capture(*literal.lexical, variable);
  }
  auto& captures = literal.literal->captures;
  for (std::size_t i = 0; i < captures.size(); ++i) {
    if (captures[i].from_closure == source.from_closure &&
        captures[i].index == source.index &&
        literal.captured_variables[i] == &variable) {
      return static_cast<std::uint32_t>(i);
    }
  }
  captures.push_back(source);
  literal.captured_variables.push_back(&variable);
  return static_cast<std::uint32_t>(captures.size() - 1);
}

namespace {

// The version of a literal, if any, through whose closures a variable comes.
const Activation* version_between(const Activation& here,
                                  const Variable& variable) {
  const Activation* a = &here;
  while (a != variable.activation && !a->is_version) a = a->lexical;
  return a == variable.activation ? nullptr : a;
}

// Variables that a literal's closures have not captured are of no use to its
// versions: they came later, or a nearer one certainly has a value.
bool is_within_reach(const Activation& here, const Variable& variable) {
  if (variable.is_statement_level) return true;
  const Activation* version = version_between(here, variable);
  return version == nullptr ||
         std::ranges::count(version->captured_variables, &variable) != 0;
}

}  // namespace

const Expression* ExpressionResolver::load(Variable& variable,
                                           SourceRange range,
                                           bool* is_certain) {
  Activation& here = *scope_->activation;
  auto* code = resolver_.make<VariableLoad>();
  code->range = range;
  *is_certain = variable.is_parameter;
  if (variable.activation == &here) {
    *is_certain = !variable.may_be_unset;
    code->run = run_local;
    code->kind = Expression::Kind::kLocal;
    code->slot = variable.slot;
  } else if (variable.is_statement_level) {
    code->hops = here.count_hops(*variable.activation);
    code->slot = variable.slot;
    code->run = code->hops == 1 ? run_outer : run_far_outer;
    if (code->hops == 1) code->kind = Expression::Kind::kOuter;
  } else {
    *is_certain = variable.is_set && !variable.may_be_unset &&
                  version_between(here, variable) == nullptr;
    if (!variable.is_set || variable.is_repeated) variable.is_boxed = true;
    code->run = run_captured;
    code->slot = capture(here, variable);
  }
  return code;
}

const Expression* ExpressionResolver::variable(std::string_view name,
                                               SourceRange range,
                                               Unknown unknown) {
  if (is_dynamic_name(name)) {
    auto* code = resolver_.make<DynamicVariable>();
    code->run = run_dynamic;
    code->range = range;
    code->index = resolver_.dynamic_index(name);
    code->name = name;
    code->is_silent = unknown == Unknown::kSilent;
    return code;
  }
  // From the innermost scope outwards, until one certainly has the variable.
  std::vector<const Expression*> candidates;
  bool is_certain = false;
  for (Scope* scope = scope_; scope != nullptr && !is_certain;
       scope = scope->parent) {
    const auto found = scope->variables.find(name);
    if (found == scope->variables.end()) continue;
    Variable& variable = *found->second;
    const bool is_here = variable.activation == scope_->activation;
    if (is_here && !variable.is_set && !variable.may_be_unset) continue;
    if (!is_within_reach(*scope_->activation, variable)) continue;
    candidates.push_back(load(variable, range, &is_certain));
    if (!is_certain && !is_here && variable.is_statement_level) {
      scope->resets.push_back(variable.slot);
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
      auto* code = resolver_.make<UnknownVariable>();
      code->run = run_unknown_variable;
      code->range = range;
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
  auto* code = resolver_.make<InexactLiteral>();
  code->run = run_inexact_literal;
  code->range = range;
  code->value = literal.value;
  code->warning = resolver_.keep_text(literal.warning);
  return code;
}

}  // namespace lamina::csg
