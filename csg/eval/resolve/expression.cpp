#include "csg/eval/resolve/expression.h"

#include <unordered_set>
#include <variant>

#include "csg/eval/run/runners.h"
#include "csg/eval/value/operators.h"
#include "parser/tree_facts.h"

namespace lamina::csg {

namespace {

using Kind = Expression::Kind;

const Value* constant_value(const Expression* code) {
  return code->kind == Kind::kConstant
             ? static_cast<const Constant*>(code)->value
             : nullptr;
}

// Holds for literals whose evaluation warns of nothing.
struct SilentTest {
  const ast::Expr& expr;

  bool operator()(const ast::Unary& unary) const {
    return std::holds_alternative<ast::Number>(unary.operand->node);
  }
  bool operator()(const ast::Vector& vector) const {
    for (const ast::Expr* element : vector.elements) {
      if (!is_silent(*element)) return false;
    }
    return true;
  }
  bool operator()(const ast::Range&) const { return false; }
  template <typename T>
  bool operator()(const T&) const {
    return ast::is_literal(expr);
  }
};

}  // namespace

bool is_silent(const ast::Expr& expr) {
  return std::visit(SilentTest{expr}, expr.node);
}

const Expression* ExpressionResolver::constant(Value value, SourceRange range) {
  const Value& kept = resolver_.keep_constant(std::move(value));
  auto* code = make<Constant>(run_constant, range);
  code->kind = Kind::kConstant;
  code->value = &kept;
  return code;
}

struct ExpressionVisitor {
  ExpressionResolver& self;
  SourceRange range;
  ExpressionResolver::Position position;

  template <typename T>
  T* make(Expression::Runner run) const {
    return self.make<T>(run, range);
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
      Reason reason;
      Value result = apply_unary(unary.op, *value, reason);
      if (reason.text.empty()) return self.constant(std::move(result), range);
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
    code->elements = self.resolver_.keep(elements);
    return code;
  }
  const Expression* operator()(const ast::Range& written) const {
    auto* code = make<RangeCode>(run_range);
    code->begin = self.resolve(*written.begin);
    if (written.step != nullptr) code->step = self.resolve(*written.step);
    code->end = self.resolve(*written.end);
    code->is_literal = ast::is_literal(*written.begin) &&
                       ast::is_literal(*written.end) &&
                       (!written.step || ast::is_literal(*written.step));
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
  // Go down a chain a + b + c + …, which leans to the left, in a loop.
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
    Reason reason;
    Value result;
    if (code->op == ast::BinaryOp::kAnd) {
      result = Value(a->is_true() && b->is_true());
    } else if (code->op == ast::BinaryOp::kOr) {
      result = Value(a->is_true() || b->is_true());
    } else {
      result = apply_binary(code->op, *a, *b, reason);
    }
    if (reason.text.empty()) left = constant(std::move(result), step.range);
  }
  return left;
}

const Expression* ExpressionResolver::let(const ast::Let& let,
                                          SourceRange range,
                                          Position position) {
  const NestedScope nested(resolver_, scope_);
  auto* code = make<LetCode>(run_let, range);
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
      const auto known = scope_->variables.find(argument.name);
      if (known != scope_->variables.end()) {
        variable = known->second;
      } else if (!is_dynamic_name(argument.name)) {
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
  static constexpr std::string_view kNames[] = {"condition", "message"};
  static const std::vector<Parameter> kParameters = make_parameters(kNames);
  auto* code = make<AssertCode>(run_assert_expression, range);
  code->kind = Kind::kAssert;
  const std::span<const WrittenArgument> given = arguments(written);
  code->plan = &resolver_.keep_plan(plan_arguments(
      kParameters, 2, given, resolver_.names(), resolver_.language()));
  for (const BoundArgument& bound : code->plan->bound) {
    if (bound.target.kind != Target::Kind::kSlot) continue;
    if (bound.target.index == 0) {
      code->condition = given[bound.written].value;
      code->condition_text = written[bound.written].value;
    } else {
      code->message = given[bound.written].value;
    }
  }
  // Where an argument is missing, 2021.01 reads the variable of that name.
  const auto fallback = [&](std::string_view name, Unknown unknown) {
    return resolver_.language() == Language::k2021
               ? variable(name, range, unknown)
               : constant(Value(), range);
  };
  if (code->condition == nullptr) {
    code->condition = fallback("condition", Unknown::kWarn);
  }
  if (code->message == nullptr) {
    code->message = fallback("message", Unknown::kSilent);
  }
  if (body != nullptr) code->body = resolve(*body, position);
  return code;
}

}  // namespace lamina::csg
