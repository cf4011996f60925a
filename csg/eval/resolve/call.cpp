// Resolving calls and function literals (see expression.h).

#include <variant>

#include "csg/eval/builtin/functions.h"
#include "csg/eval/resolve/expression.h"
#include "csg/eval/run/runners.h"

namespace lamina::csg {

const Expression* ExpressionResolver::call(const ast::Call& call,
                                           SourceRange range,
                                           Position position) {
  auto* code = resolver_.make<CallCode>();
  code->range = range;
  const auto* name = std::get_if<ast::Variable>(&call.callee->node);
  code->is_name = name != nullptr;
  if (name == nullptr) {
    code->callee_text = call.callee;
    code->callee = resolve(*call.callee);
    code->arguments = arguments(call.arguments);
    code->run = run_call_value;
  } else {
    code->name = name->name;
    const Expression* variable =
        this->variable(name->name, call.callee->range, Unknown::kSilent);
    if (variable->kind != Expression::Kind::kConstant) {
      code->callee = variable;
      code->run = run_call_value;
    }
    const auto callee = resolver_.find(*scope_, name->name, &Scope::functions);
    if (callee.code == nullptr) {
      const BuiltinFunctionRow* row = find_builtin_function(name->name);
      if (row != nullptr) {
        code->builtin = row->function;
        code->math = row->math;
      }
    }
    const auto* plain =
        call.arguments.size() == 1
            ? std::get_if<ast::Variable>(&call.arguments[0].value->node)
            : nullptr;
    if (plain != nullptr && code->builtin == builtin_is_undef) {
      // is_undef() of an unknown variable does not warn.
      std::vector<WrittenArgument> asked = {
          {call.arguments[0].name,
           this->variable(plain->name, range, Unknown::kSilent)}};
      code->arguments = resolver_.keep(asked);
    } else {
      code->arguments = arguments(call.arguments);
    }
    if (callee.code != nullptr) {
      code->function = &resolver_.with_extras(*callee.code, code->arguments);
      code->is_foreign = callee.is_foreign;
      if (!callee.is_foreign) {
        code->hops =
            scope_->activation->count_hops(*callee.code->scope->activation);
      }
      code->plan = &resolver_.keep_plan(plan_arguments(
          code->function->parameters, callee.code->parameters.size(),
          code->arguments, resolver_.names(), resolver_.language()));
      if (code->callee == nullptr) code->run = run_call_function;
    } else if (code->callee == nullptr) {
      code->run = code->builtin == nullptr ? run_call_unknown
                  : code->math != nullptr && code->arguments.size() == 1
                      ? run_call_math
                      : run_call_builtin;
    }
  }
  if (code->callee != nullptr) code->number = resolver_.next_call_number();
  if (position == Position::kTail) make_tail_call(*code, call);
  return code;
}

// Makes a jump of a call by which a function calls itself last, and lets others
// be deferred.
void ExpressionResolver::make_tail_call(CallCode& code, const ast::Call& call) {
  Activation& here = *scope_->activation;
  if (here.callable == nullptr) return;
  if (resolver_.language() != Language::k2021 &&
      (code.function != nullptr || code.callee != nullptr)) {
    code.may_be_deferred = true;
    code.kind = Expression::Kind::kTailCall;
    here.callable->has_tail_calls = true;
  }
  if (!code.is_name) return;
  if (here.kind == Activation::Kind::kFunction) {
    auto& self = static_cast<Function&>(*here.callable);
    if (code.function == nullptr || code.callee != nullptr ||
        code.function->definition != self.definition) {
      return;
    }
    code.is_self_call = true;
    // Variables that callers of this version named besides keep their values.
    if (&resolver_.with_extras(self, code.arguments) != &self) return;
    code.function = &self;
    *code.plan =
        plan_arguments(self.parameters, self.definition->parameters.size(),
                       code.arguments, resolver_.names(), resolver_.language());
    std::vector<BoundArgument> moved;
    for (const BoundArgument& bound : code.plan->bound) {
      const Expression& argument = *code.arguments[bound.written].value;
      const bool is_same = bound.target.kind == Target::Kind::kSlot &&
                           argument.kind == Expression::Kind::kLocal &&
                           argument.slot == bound.target.index;
      if (!is_same) moved.push_back(bound);
    }
    code.tail_arguments = resolver_.keep(moved);
    std::vector<CallCode::TailDefault> defaults;
    for (const std::uint32_t i : code.plan->defaults) {
      const Parameter& parameter = code.function->parameters[i];
      CallCode::TailDefault fallback;
      fallback.target = parameter.target;
      fallback.is_evaluated_once = resolver_.language() == Language::k2021;
      fallback.value = parameter.fallback_text == nullptr
                           ? constant(Value(), call.callee->range)
                       : fallback.is_evaluated_once
                           ? resolve(*parameter.fallback_text)
                           : parameter.fallback;
      fallback.number = resolver_.next_tail_default_number();
      defaults.push_back(fallback);
    }
    code.tail_defaults = resolver_.keep(defaults);
    code.is_jump = true;
  } else if (code.callee == nullptr) {
    return;
  }
  code.kind = Expression::Kind::kTailCall;
  here.callable->has_tail_calls = true;
}

const Expression* ExpressionResolver::function_literal(
    const ast::FunctionLiteral& written, SourceRange range) {
  FunctionLiteral& literal = resolver_.new_literal();
  literal.definition = &written;
  literal.document = scope_->unit->document;
  literal.scope = scope_;
  Activation& around = *scope_->activation;
  Activation& activation =
      resolver_.open_activation(Activation::Kind::kLiteral, around);
  activation.literal = &literal;
  activation.callable = &literal;
  literal.activation = &activation;
  literal.hops = around.is_statement_level() ? 0 : 1;
  Scope& inner = resolver_.open_scope(*scope_, activation);
  resolver_.resolve_callable(literal, written.parameters, *written.body, inner,
                             *scope_);
  auto* code = make<LiteralCode>(run_function_literal, range);
  code->literal = &literal;
  return code;
}

}  // namespace lamina::csg
