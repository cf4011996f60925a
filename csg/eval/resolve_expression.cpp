#include "csg/eval/resolve_expression.h"

#include <algorithm>
#include <numbers>
#include <unordered_set>
#include <variant>

#include <fmt/format.h>

#include "csg/eval/builtin_functions.h"
#include "csg/eval/literals.h"
#include "csg/eval/operators.h"
#include "csg/eval/run_expression.h"
#include "csg/eval/text.h"

namespace lamina::csg {

namespace {

using Kind = Expression::Kind;

const Value* constant_value(const Expression* code) {
  return code->kind == Kind::kConstant
             ? static_cast<const Constant*>(code)->value
             : nullptr;
}

// How many static links lead from one activation to another.
std::uint32_t count_hops(const Activation& from, const Activation& to) {
  std::uint32_t hops = 0;
  for (const Activation* a = &from; a != &to; a = a->link) ++hops;
  return hops;
}

// A scope of expression variables; its slots are free again when it closes.
class NestedScope {
 public:
  NestedScope(Scope*& current, Scope& inner)
      : current_(current),
        outer_(current),
        first_slot_(inner.activation->next_slot) {
    current = &inner;
  }
  ~NestedScope() {
    current_->activation->next_slot = first_slot_;
    current_ = outer_;
  }
  NestedScope(const NestedScope&) = delete;
  NestedScope& operator=(const NestedScope&) = delete;

 private:
  Scope*& current_;
  Scope* outer_;
  std::uint32_t first_slot_;
};

struct LiteralTest {
  bool operator()(const ast::Undef&) const { return true; }
  bool operator()(const ast::Bool&) const { return true; }
  bool operator()(const ast::Number&) const { return true; }
  bool operator()(const ast::String&) const { return true; }
  bool operator()(const ast::Numbers&) const { return true; }
  bool operator()(const ast::Unary& unary) const {
    return is_literal(*unary.operand);
  }
  bool operator()(const ast::Vector& vector) const {
    for (const ast::Expr* element : vector.elements) {
      if (!is_literal(*element)) return false;
    }
    return true;
  }
  bool operator()(const ast::Range& range) const {
    return is_literal(*range.begin) && is_literal(*range.end) &&
           (range.step == nullptr || is_literal(*range.step));
  }
  template <typename T>
  bool operator()(const T&) const {
    return false;
  }
};

}  // namespace

bool is_literal(const ast::Expr& expr) {
  return std::visit(LiteralTest(), expr.node);
}

const Expression* ExpressionResolver::constant(Value value, SourceRange range) {
  const Value& kept = resolver_.keep_constant(std::move(value));
  auto* code = resolver_.make<Constant>();
  code->run = run_constant;
  code->range = range;
  code->kind = Kind::kConstant;
  code->value = &kept;
  return code;
}

// --- Variables --------------------------------------------------------------

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
    code->kind = Kind::kLocal;
    code->slot = variable.slot;
  } else if (variable.is_statement_level) {
    code->hops = count_hops(here, *variable.activation);
    code->slot = variable.slot;
    code->run = code->hops == 1 ? run_outer : run_far_outer;
    if (code->hops == 1) code->kind = Kind::kOuter;
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

// --- Expressions ------------------------------------------------------------

struct ExpressionVisitor {
  ExpressionResolver& self;
  SourceRange range;
  ExpressionResolver::Position position;

  Resolver& resolver() const { return self.resolver_; }
  template <typename T>
  T* make(Expression::Run run) const {
    T* code = resolver().make<T>();
    code->run = run;
    code->range = range;
    return code;
  }

  const Expression* operator()(const ast::Undef&) const {
    return self.constant(Value(), range);
  }
  const Expression* operator()(const ast::Bool& literal) const {
    return self.constant(Value(literal.value), range);
  }
  const Expression* operator()(const ast::Number& literal) const {
    return self.constant(Value(literal.value), range);
  }
  const Expression* operator()(const ast::String& literal) const {
    return self.constant(Value::string(literal.value), range);
  }
  const Expression* operator()(const ast::Numbers& literal) const {
    return self.constant(Value::numbers(literal.values), range);
  }
  const Expression* operator()(const ast::Variable& variable) const {
    return self.variable(variable.name, range,
                         ExpressionResolver::Unknown::kWarn);
  }
  const Expression* operator()(const ast::Unary& unary) const {
    const Expression* operand = self.resolve(*unary.operand);
    if (const Value* value = constant_value(operand)) {
      std::string reason;
      Value result = apply_unary(unary.op, *value, reason);
      if (reason.empty()) return self.constant(std::move(result), range);
    }
    auto* code = make<UnaryCode>(unary_runner(unary.op));
    code->operand = operand;
    return code;
  }
  const Expression* operator()(const ast::Binary& binary) const {
    return self.binary(binary, range);
  }
  const Expression* operator()(const ast::Conditional& conditional) const {
    auto* code = make<ConditionalCode>(run_conditional);
    code->kind = Kind::kConditional;
    code->condition = self.resolve(*conditional.condition);
    code->if_true = self.resolve(*conditional.if_true, position);
    code->if_false = self.resolve(*conditional.if_false, position);
    return code;
  }
  const Expression* operator()(const ast::Vector& vector) const {
    std::vector<const Element*> elements;
    VectorBuilder values;
    for (const ast::Expr* expr : vector.elements) {
      elements.push_back(self.element(*expr));
      const Expression* value = elements.back()->value;
      if (value == nullptr) continue;
      if (const Value* known = constant_value(value)) values.push(*known);
    }
    if (values.size() == elements.size()) {
      return self.constant(values.finish(), range);
    }
    auto* code = make<VectorCode>(run_vector);
    code->elements = resolver().keep(elements);
    return code;
  }
  const Expression* operator()(const ast::Range& written) const {
    auto* code = make<RangeCode>(run_range);
    code->begin = self.resolve(*written.begin);
    if (written.step != nullptr) code->step = self.resolve(*written.step);
    code->end = self.resolve(*written.end);
    code->is_literal = is_literal(*written.begin) && is_literal(*written.end) &&
                       (!written.step || is_literal(*written.step));
    return code;
  }
  const Expression* operator()(const ast::Index& index) const {
    auto* code = make<BinaryCode>(run_index);
    code->kind = Kind::kIndex;
    code->left = self.resolve(*index.object);
    code->right = self.resolve(*index.index);
    return code;
  }
  const Expression* operator()(const ast::Member& member) const {
    auto* code = make<MemberCode>(run_member);
    code->object = self.resolve(*member.object);
    code->name = member.name;
    return code;
  }
  const Expression* operator()(const ast::Call& call) const {
    return self.call(call, range, position);
  }
  const Expression* operator()(const ast::FunctionLiteral& literal) const {
    return self.function_literal(literal, range);
  }
  const Expression* operator()(const ast::Let& let) const {
    return self.let(let, range, position);
  }
  const Expression* operator()(const ast::AssertExpr& written) const {
    return self.assertion(written.arguments, written.body, range, position);
  }
  const Expression* operator()(const ast::EchoExpr& written) const {
    auto* code = make<EchoCode>(run_echo);
    code->kind = Kind::kEcho;
    code->arguments = self.arguments(written.arguments);
    if (written.body != nullptr) {
      code->body = self.resolve(*written.body, position);
    }
    return code;
  }
  // Elements of comprehensions stand in vectors only.
  template <typename T>
  const Expression* operator()(const T&) const {
    return self.constant(Value(), range);
  }
};

const Expression* ExpressionResolver::resolve(const ast::Expr& expr,
                                              Position position) {
  return std::visit(ExpressionVisitor{*this, expr.range, position}, expr.node);
}

const Expression* ExpressionResolver::binary(const ast::Binary& written,
                                             SourceRange range) {
  // A chain a + b + c + … leans to the left; go down it in a loop.
  struct Step {
    const ast::Binary* binary;
    SourceRange range;
  };
  std::vector<Step> chain = {{&written, range}};
  while (const auto* inner =
             std::get_if<ast::Binary>(&chain.back().binary->left->node)) {
    chain.push_back({inner, chain.back().binary->left->range});
  }
  const Expression* left = resolve(*chain.back().binary->left);
  for (; !chain.empty(); chain.pop_back()) {
    const Step& step = chain.back();
    auto* code = resolver_.make<BinaryCode>();
    code->op = step.binary->op;
    code->range = step.range;
    code->left = left;
    code->right = resolve(*step.binary->right);
    code->run = binary_runner(code->op, *code->left, *code->right);
    left = code;
    const Value* a = constant_value(code->left);
    const Value* b = constant_value(code->right);
    if (a == nullptr || b == nullptr) continue;
    std::string reason;
    Value result;
    if (code->op == ast::BinaryOp::kAnd) {
      result = Value(a->is_true() && b->is_true());
    } else if (code->op == ast::BinaryOp::kOr) {
      result = Value(a->is_true() || b->is_true());
    } else {
      result = apply_binary(code->op, *a, *b, reason);
    }
    if (reason.empty()) left = constant(std::move(result), step.range);
  }
  return left;
}

const Expression* ExpressionResolver::let(const ast::Let& let,
                                          SourceRange range,
                                          Position position) {
  const NestedScope nested(scope_,
                           resolver_.open_scope(*scope_, *scope_->activation));
  auto* code = resolver_.make<LetCode>();
  code->run = run_let;
  code->range = range;
  code->kind = Kind::kLet;
  code->bindings = sequential_bindings(let.bindings, range, false);
  code->body = resolve(*let.body, position);
  return code;
}

Bindings ExpressionResolver::sequential_bindings(ast::Arguments written,
                                                 SourceRange range,
                                                 bool is_statement_level) {
  std::vector<Binding> bindings;
  std::vector<Variable*> variables;
  std::unordered_set<std::string_view> names;
  for (const ast::Argument& argument : written) {
    Binding binding;
    binding.name = argument.name;
    binding.range = range;
    binding.is_duplicate =
        !argument.name.empty() && !names.insert(argument.name).second;
    Variable* variable = nullptr;
    if (!argument.name.empty() && !binding.is_duplicate) {
      if (!is_dynamic_name(argument.name)) {
        variable = declare(argument.name, is_statement_level);
      }
      binding.target = target(argument.name, variable);
    }
    variables.push_back(variable);
    bindings.push_back(binding);
  }
  for (std::size_t i = 0; i < bindings.size(); ++i) {
    bindings[i].value = resolve(*written[i].value);
    if (variables[i] != nullptr) variables[i]->is_set = true;
  }
  return resolver_.keep(bindings);
}

std::span<const WrittenArgument> ExpressionResolver::arguments(
    ast::Arguments written) {
  std::vector<WrittenArgument> arguments;
  for (const ast::Argument& argument : written) {
    arguments.push_back({argument.name, resolve(*argument.value)});
  }
  return resolver_.keep(arguments);
}

const AssertCode* ExpressionResolver::assertion(ast::Arguments written,
                                                const ast::Expr* body,
                                                SourceRange range,
                                                Position position) {
  static const std::vector<Parameter> kParameters = [] {
    std::vector<Parameter> parameters(2);
    parameters[0].name = "condition";
    parameters[0].target = {Target::Kind::kSlot, 0, nullptr};
    parameters[1].name = "message";
    parameters[1].target = {Target::Kind::kSlot, 1, nullptr};
    return parameters;
  }();
  auto* code = resolver_.make<AssertCode>();
  code->run = run_assert_expression;
  code->range = range;
  code->kind = Kind::kAssert;
  const std::span<const WrittenArgument> given = arguments(written);
  code->plan = &resolver_.keep_plan(resolver_.plan(kParameters, 2, given));
  for (const BoundArgument& bound : code->plan->bound) {
    if (bound.target.kind != Target::Kind::kSlot) continue;
    if (bound.target.index == 0) {
      code->condition = given[bound.written].value;
      code->condition_text = written[bound.written].value;
    } else {
      code->message = given[bound.written].value;
    }
  }
  // OpenSCAD looks for what is not given among the variables around.
  if (code->condition == nullptr) {
    code->condition = variable("condition", range, Unknown::kWarn);
  }
  if (code->message == nullptr) {
    code->message = variable("message", range, Unknown::kSilent);
  }
  if (body != nullptr) code->body = resolve(*body, position);
  return code;
}

// --- Calls ------------------------------------------------------------------

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
    if (variable->kind != Kind::kConstant) {
      code->callee = variable;
      code->run = run_call_value;
    }
    const Resolver::Callee callee =
        resolver_.find_function(*scope_, name->name);
    if (callee.function == nullptr) {
      const BuiltinFunctionEntry* entry = find_builtin_function(name->name);
      if (entry != nullptr) {
        code->builtin = entry->function;
        code->math = entry->math;
      }
    }
    const auto* plain =
        call.arguments.size() == 1
            ? std::get_if<ast::Variable>(&call.arguments[0].value->node)
            : nullptr;
    if (plain != nullptr && code->builtin == builtin_is_undef) {
      // Asking whether a variable is undefined is no offence.
      std::vector<WrittenArgument> asked = {
          {call.arguments[0].name,
           this->variable(plain->name, range, Unknown::kSilent)}};
      code->arguments = resolver_.keep(asked);
    } else {
      code->arguments = arguments(call.arguments);
    }
    if (callee.function != nullptr) {
      code->function =
          &resolver_.with_extras(*callee.function, code->arguments);
      code->is_foreign = callee.is_foreign;
      if (!callee.is_foreign) {
        code->hops = count_hops(*scope_->activation,
                                *callee.function->scope->activation);
      }
      code->plan = &resolver_.keep_plan(
          resolver_.plan(code->function->parameters,
                         callee.function->parameters.size(), code->arguments));
      if (code->callee == nullptr) code->run = run_call_function;
    } else if (code->callee == nullptr) {
      code->run = code->math != nullptr && code->arguments.size() == 1
                      ? run_call_math
                      : run_call_builtin;
      if (code->builtin == nullptr && code->math == nullptr) {
        code->run = run_call_unknown;
      }
    }
  }
  if (position == Position::kTail) make_tail_call(*code, call);
  return code;
}

// A call of the function whose body this is, as its last act, is a jump.
void ExpressionResolver::make_tail_call(CallCode& code, const ast::Call& call) {
  Activation& here = *scope_->activation;
  if (here.callable == nullptr || !code.is_name) return;
  if (here.kind == Activation::Kind::kFunction) {
    auto& self = static_cast<Function&>(*here.callable);
    if (code.function == nullptr || code.callee != nullptr ||
        code.function->definition != self.definition) {
      return;
    }
    code.is_self_call = true;
    // What the caller of this version named besides stays what it is.
    if (&resolver_.with_extras(self, code.arguments) != &self) return;
    code.function = &self;
    *code.plan = resolver_.plan(
        self.parameters, self.definition->parameters.size(), code.arguments);
    std::vector<BoundArgument> moved;
    for (const BoundArgument& bound : code.plan->bound) {
      const Expression& argument = *code.arguments[bound.written].value;
      const bool is_same = bound.target.kind == Target::Kind::kSlot &&
                           argument.kind == Kind::kLocal &&
                           argument.slot == bound.target.index;
      if (!is_same) moved.push_back(bound);
    }
    code.tail_arguments = resolver_.keep(moved);
    code.tail_defaults = &resolver_.new_tail_defaults();
    for (const std::uint32_t i : code.plan->defaults) {
      const Parameter& parameter = code.function->parameters[i];
      CallCode::TailDefault fallback;
      fallback.target = parameter.target;
      fallback.value = parameter.fallback_text != nullptr
                           ? resolve(*parameter.fallback_text)
                           : constant(Value(), call.callee->range);
      code.tail_defaults->push_back(std::move(fallback));
    }
  } else if (code.callee == nullptr) {
    return;
  }
  code.kind = Kind::kTailCall;
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
  auto* code = resolver_.make<LiteralCode>();
  code->run = run_function_literal;
  code->range = range;
  code->literal = &literal;
  return code;
}

// --- Elements ---------------------------------------------------------------

struct ElementVisitor {
  ExpressionResolver& self;
  const ast::Expr& expr;

  template <typename T>
  T* make(Element::Emit emit) const {
    T* code = self.resolver_.make<T>();
    code->emit = emit;
    code->range = expr.range;
    return code;
  }

  const Element* operator()(const ast::ForElements& loop) const {
    return self.for_element(loop.bindings, 0, *loop.body, expr.range);
  }
  const Element* operator()(const ast::ForCElements& loop) const {
    return self.for_c_element(loop, expr.range);
  }
  const Element* operator()(const ast::IfElements& written) const {
    auto* code = make<IfElement>(emit_if);
    code->condition = self.resolve(*written.condition);
    code->if_true = self.element(*written.if_true);
    if (written.if_false != nullptr) {
      code->if_false = self.element(*written.if_false);
    }
    return code;
  }
  const Element* operator()(const ast::EachElements& each) const {
    auto* code = make<EachElement>(emit_each);
    code->body = self.element(*each.body);
    return code;
  }
  const Element* operator()(const ast::LetElements& let) const {
    const NestedScope nested(
        self.scope_,
        self.resolver_.open_scope(*self.scope_, *self.scope_->activation));
    auto* code = make<LetElement>(emit_let);
    code->bindings = self.sequential_bindings(let.bindings, expr.range, false);
    code->body = self.element(*let.body);
    return code;
  }
  template <typename T>
  const Element* operator()(const T&) const {
    auto* code = make<Element>(emit_value);
    code->value = self.resolve(expr);
    return code;
  }
};

const Element* ExpressionResolver::element(const ast::Expr& expr) {
  return std::visit(ElementVisitor{*this, expr}, expr.node);
}

const Element* ExpressionResolver::for_element(ast::Arguments bindings,
                                               std::size_t first,
                                               const ast::Expr& body,
                                               SourceRange range) {
  if (first == bindings.size()) return element(body);
  const ast::Argument& written = bindings[first];
  auto* code = resolver_.make<ForElement>();
  code->emit = emit_for;
  code->range = range;
  code->binding.name = written.name;
  code->binding.range = range;
  code->binding.value = resolve(*written.value);
  const NestedScope nested(scope_,
                           resolver_.open_scope(*scope_, *scope_->activation));
  Variable* variable = nullptr;
  if (!is_dynamic_name(written.name)) {
    variable = declare(written.name, false);
    variable->is_set = true;
    variable->is_repeated = true;
  }
  code->binding.target = target(written.name, variable);
  code->body = for_element(bindings, first + 1, body, range);
  return code;
}

const Element* ExpressionResolver::for_c_element(const ast::ForCElements& loop,
                                                 SourceRange range) {
  const NestedScope nested(scope_,
                           resolver_.open_scope(*scope_, *scope_->activation));
  auto* code = resolver_.make<ForCElement>();
  code->emit = emit_for_c;
  code->range = range;
  code->init = sequential_bindings(loop.head->init, range, false);
  // What only the update names is a variable from the second round on.
  for (const ast::Argument& update : loop.head->update) {
    if (update.name.empty() || is_dynamic_name(update.name)) continue;
    Variable*& variable = scope_->variables[update.name];
    if (variable == nullptr) {
      variable = declare(update.name, false);
      variable->may_be_unset = true;
    }
    variable->is_repeated = true;
  }
  code->condition = resolve(*loop.head->condition);
  code->body = element(*loop.body);
  Scope& loop_scope = *scope_;
  const NestedScope update_scope(
      scope_, resolver_.open_scope(*scope_, *scope_->activation));
  code->update = sequential_bindings(loop.head->update, range, false);
  std::vector<std::pair<Target, Target>> copies;
  for (const Binding& binding : code->update) {
    if (binding.target.kind != Target::Kind::kSlot) continue;
    copies.emplace_back(
        binding.target,
        target(binding.name, loop_scope.variables.at(binding.name)));
  }
  code->copies = resolver_.keep(copies);
  return code;
}

}  // namespace lamina::csg
