#include "csg/eval/run_expression.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "csg/eval/builtin_functions.h"
#include "csg/eval/interpreter.h"
#include "csg/eval/object.h"
#include "csg/eval/operators.h"
#include "csg/eval/resolver.h"
#include "csg/eval/text.h"

namespace lamina::csg {

namespace {

using ast::BinaryOp;

template <typename T>
const T& as(const Expression& expression) {
  return static_cast<const T&>(expression);
}

// Most messages are never made: keep their code out of the hot functions.
[[gnu::noinline]] void warn(Frame& frame, SourceRange range,
                            std::string message) {
  frame.in.warn(range, std::move(message), frame.document);
}

}  // namespace

// --- Variables --------------------------------------------------------------

Value run_constant(const Expression& expression, Frame&) {
  return *as<Constant>(expression).value;
}

namespace {
// A slot that is unset or boxed.
[[gnu::noinline]] Value load_unusual(const VariableLoad& code,
                                     const Value& value, Frame& frame) {
  if (value.type() == Type::kBox && !value.as_box().value.is_unset()) {
    return value.as_box().value;
  }
  return run(code.otherwise, frame);
}
Value load(const VariableLoad& code, const Value& value, Frame& frame) {
  if (is_plain(value)) [[likely]]
    return value;
  return load_unusual(code, value, frame);
}
}  // namespace

Value run_local(const Expression& expression, Frame& frame) {
  return load(as<VariableLoad>(expression), frame.slots[expression.slot],
              frame);
}
Value run_outer(const Expression& expression, Frame& frame) {
  return load(as<VariableLoad>(expression), frame.link->slots[expression.slot],
              frame);
}
Value run_far_outer(const Expression& expression, Frame& frame) {
  const auto& code = as<VariableLoad>(expression);
  const Frame* home = &frame;
  for (std::uint32_t i = 0; i < code.hops; ++i) home = home->link;
  return load(code, home->slots[code.slot], frame);
}
Value run_captured(const Expression& expression, Frame& frame) {
  return load(as<VariableLoad>(expression),
              frame.closure->captured[expression.slot], frame);
}
Value run_dynamic(const Expression& expression, Frame& frame) {
  const auto& code = as<DynamicVariable>(expression);
  const Value& value = frame.in.dynamic(code.index);
  if (!value.is_unset()) return value;
  if (!code.is_silent) {
    warn(frame, code.range,
         fmt::format("Ignoring unknown variable '{}'", code.name));
  }
  return Value();
}
Value run_inexact_literal(const Expression& expression, Frame& frame) {
  const auto& code = as<InexactLiteral>(expression);
  warn(frame, code.range, std::string(code.warning));
  return Value(code.value);
}
Value run_unknown_variable(const Expression& expression, Frame& frame) {
  frame.in.warn(expression.range,
                fmt::format("Ignoring unknown variable '{}'",
                            as<UnknownVariable>(expression).name));
  return Value();
}

// --- Operators --------------------------------------------------------------

namespace {

Value run_not(const Expression& expression, Frame& frame) {
  return Value(!is_true(as<UnaryCode>(expression).operand, frame));
}

Value run_negate(const Expression& expression, Frame& frame) {
  Value spill;
  const Value& operand = look(as<UnaryCode>(expression).operand, frame, spill);
  if (operand.is_number()) return Value(-operand.as_number());
  std::string reason;
  Value result = negate(operand, reason);
  if (!reason.empty()) warn(frame, expression.range, std::move(reason));
  return result;
}

Value run_bit_not(const Expression& expression, Frame& frame) {
  Value spill;
  const Value& operand = look(as<UnaryCode>(expression).operand, frame, spill);
  std::string reason;
  Value result = apply_unary(ast::UnaryOp::kBitNot, operand, reason);
  if (!reason.empty()) warn(frame, expression.range, std::move(reason));
  return result;
}

}  // namespace

Expression::Run unary_runner(ast::UnaryOp op) {
  switch (op) {
    case ast::UnaryOp::kNot:
      return run_not;
    case ast::UnaryOp::kNegate:
      return run_negate;
    case ast::UnaryOp::kBitNot:
      return run_bit_not;
  }
  return run_not;
}

namespace {

// Operands that are not both numbers, or bits.
[[gnu::noinline]] Value run_binary_any(const BinaryCode& code,
                                       const Value& left, const Value& right,
                                       Frame& frame) {
  std::string reason;
  Value result = apply_binary(code.op, left, right, reason);
  if (!reason.empty()) warn(frame, code.range, std::move(reason));
  return result;
}

template <BinaryOp op>
Value on_numbers(double a, double b) {
  if constexpr (op == BinaryOp::kEqual) return Value(a == b);
  if constexpr (op == BinaryOp::kNotEqual) return Value(a != b);
  if constexpr (op == BinaryOp::kLess) return Value(a < b);
  if constexpr (op == BinaryOp::kLessEqual) return Value(a <= b);
  if constexpr (op == BinaryOp::kGreater) return Value(a > b);
  if constexpr (op == BinaryOp::kGreaterEqual) return Value(a >= b);
  if constexpr (op == BinaryOp::kAdd) return Value(a + b);
  if constexpr (op == BinaryOp::kSubtract) return Value(a - b);
  if constexpr (op == BinaryOp::kMultiply) return Value(a * b);
  if constexpr (op == BinaryOp::kDivide) return Value(a / b);
  if constexpr (op == BinaryOp::kModulo) return Value(modulo(a, b));
  if constexpr (op == BinaryOp::kPower) return Value(std::pow(a, b));
}

// An operand, by the way its value is reached. Most are plain variables,
// constants and results; knowing which while resolving saves the question.
enum class Reach : std::uint8_t { kLooked, kLocal, kConstant, kComputed };

Reach reach_of(const Expression& code) {
  switch (code.kind) {
    case Expression::Kind::kLocal:
      return Reach::kLocal;
    case Expression::Kind::kConstant:
      return Reach::kConstant;
    case Expression::Kind::kOuter:
    case Expression::Kind::kIndex:
      return Reach::kLooked;
    default:
      return Reach::kComputed;
  }
}

template <Reach reach>
class Operand {
 public:
  Operand(const Expression* code, Frame& frame)
      : value_(look(code, frame, spill_)) {}
  const Value& value() const { return value_; }

 private:
  Value spill_;
  const Value& value_;
};
template <>
class Operand<Reach::kLocal> {
 public:
  Operand(const Expression* code, Frame& frame)
      : value_(is_plain(frame.slots[code->slot])
                   ? frame.slots[code->slot]
                   : look_further(code, frame, spill_)) {}
  const Value& value() const { return value_; }

 private:
  Value spill_;
  const Value& value_;
};
template <>
class Operand<Reach::kConstant> {
 public:
  Operand(const Expression* code, Frame&)
      : value_(*static_cast<const Constant*>(code)->value) {}
  const Value& value() const { return value_; }

 private:
  const Value& value_;
};
template <>
class Operand<Reach::kComputed> {
 public:
  Operand(const Expression* code, Frame& frame) : value_(run(code, frame)) {}
  const Value& value() const { return value_; }

 private:
  Value value_;
};

// The right operand goes first, as in the released openscad: messages of both
// come in that order.
template <BinaryOp op, Reach left_reach, Reach right_reach>
Value run_binary(const Expression& expression, Frame& frame) {
  const auto& code = as<BinaryCode>(expression);
  const Operand<right_reach> right(code.right, frame);
  const Operand<left_reach> left(code.left, frame);
  const Value& a = left.value();
  const Value& b = right.value();
  if (a.is_number() && b.is_number()) [[likely]] {
    return on_numbers<op>(a.as_number(), b.as_number());
  }
  return run_binary_any(code, a, b, frame);
}

Value run_bitwise(const Expression& expression, Frame& frame) {
  const auto& code = as<BinaryCode>(expression);
  Value spill_left;
  Value spill_right;
  const Value& right = look(code.right, frame, spill_right);
  const Value& left = look(code.left, frame, spill_left);
  return run_binary_any(code, left, right, frame);
}

Value run_and(const Expression& expression, Frame& frame) {
  const auto& code = as<BinaryCode>(expression);
  return Value(is_true(code.left, frame) && is_true(code.right, frame));
}
Value run_or(const Expression& expression, Frame& frame) {
  const auto& code = as<BinaryCode>(expression);
  return Value(is_true(code.left, frame) || is_true(code.right, frame));
}

}  // namespace

namespace {

template <BinaryOp op, Reach left>
Expression::Run runner_for(const Expression& right) {
  switch (reach_of(right)) {
    case Reach::kLocal:
      return run_binary<op, left, Reach::kLocal>;
    case Reach::kConstant:
      return run_binary<op, left, Reach::kConstant>;
    case Reach::kComputed:
      return run_binary<op, left, Reach::kComputed>;
    default:
      return run_binary<op, left, Reach::kLooked>;
  }
}
template <BinaryOp op>
Expression::Run runner_for(const Expression& left, const Expression& right) {
  switch (reach_of(left)) {
    case Reach::kLocal:
      return runner_for<op, Reach::kLocal>(right);
    case Reach::kComputed:
      return runner_for<op, Reach::kComputed>(right);
    default:
      return runner_for<op, Reach::kLooked>(right);
  }
}

}  // namespace

Expression::Run binary_runner(BinaryOp op, const Expression& left,
                              const Expression& right) {
  switch (op) {
    case BinaryOp::kOr:
      return run_or;
    case BinaryOp::kAnd:
      return run_and;
    case BinaryOp::kEqual:
      return runner_for<BinaryOp::kEqual>(left, right);
    case BinaryOp::kNotEqual:
      return runner_for<BinaryOp::kNotEqual>(left, right);
    case BinaryOp::kLess:
      return runner_for<BinaryOp::kLess>(left, right);
    case BinaryOp::kLessEqual:
      return runner_for<BinaryOp::kLessEqual>(left, right);
    case BinaryOp::kGreater:
      return runner_for<BinaryOp::kGreater>(left, right);
    case BinaryOp::kGreaterEqual:
      return runner_for<BinaryOp::kGreaterEqual>(left, right);
    case BinaryOp::kBitOr:
    case BinaryOp::kBitAnd:
    case BinaryOp::kShiftLeft:
    case BinaryOp::kShiftRight:
      return run_bitwise;
    case BinaryOp::kAdd:
      return runner_for<BinaryOp::kAdd>(left, right);
    case BinaryOp::kSubtract:
      return runner_for<BinaryOp::kSubtract>(left, right);
    case BinaryOp::kMultiply:
      return runner_for<BinaryOp::kMultiply>(left, right);
    case BinaryOp::kDivide:
      return runner_for<BinaryOp::kDivide>(left, right);
    case BinaryOp::kModulo:
      return runner_for<BinaryOp::kModulo>(left, right);
    default:
      return runner_for<BinaryOp::kPower>(left, right);
  }
}

Value run_conditional(const Expression& expression, Frame& frame) {
  const auto& code = as<ConditionalCode>(expression);
  return run(is_true(code.condition, frame) ? code.if_true : code.if_false,
             frame);
}

namespace {
// An element of a vector that stands in memory; otherwise as `look`.
const Value& look_at_element(const BinaryCode& code, Frame& frame,
                             Value& spill) {
  Value spill_object;
  Value spill_index;
  const Value& i = look(code.right, frame, spill_index);
  const Value& object = look(code.left, frame, spill_object);
  if (object.is_vector() && &object != &spill_object && i.is_number()) {
    const std::span<const Value> elements = object.as_vector();
    const double number = i.as_number();
    // Cut towards zero, as index() does.
    if (number >= 0 && number < static_cast<double>(elements.size())) {
      return elements[static_cast<std::uint32_t>(number)];
    }
  }
  spill = index(object, i);
  return spill;
}
}  // namespace

Value run_index(const Expression& expression, Frame& frame) {
  Value spill;
  const Value& element =
      look_at_element(as<BinaryCode>(expression), frame, spill);
  if (&element == &spill) return spill;
  return element;
}

const Value& look_further(const Expression* code, Frame& frame, Value& spill) {
  if (code->kind == Expression::Kind::kOuter &&
      is_plain(frame.link->slots[code->slot])) {
    return frame.link->slots[code->slot];
  }
  if (code->kind == Expression::Kind::kIndex) {
    return look_at_element(as<BinaryCode>(*code), frame, spill);
  }
  spill = run(code, frame);
  return spill;
}

Value run_member(const Expression& expression, Frame& frame) {
  const auto& code = as<MemberCode>(expression);
  Value spill;
  return member(look(code.object, frame, spill), code.name);
}

Value run_range(const Expression& expression, Frame& frame) {
  const auto& code = as<RangeCode>(expression);
  const Value first = run(code.begin, frame);
  if (!first.is_number()) return Value();
  const Value last = run(code.end, frame);
  if (!last.is_number()) return Value();
  const double begin = first.as_number();
  const double end = last.as_number();
  if (code.step == nullptr) {
    if (end >= begin || std::isnan(begin) || std::isnan(end)) {
      return Value::range(begin, 1, end);
    }
    frame.in.deprecate(code.range,
                       "Using ranges of the form [begin:end] with begin value "
                       "greater than the end value is deprecated",
                       frame.document);
    return Value::range(end, 1, begin);
  }
  const Value step = run(code.step, frame);
  if (!step.is_number()) return Value();
  if (code.is_literal) {
    if (step.as_number() > 0 && end < begin) {
      warn(frame, code.range,
           "begin is greater than the end, but step is positive");
    } else if (step.as_number() < 0 && end > begin) {
      warn(frame, code.range,
           "begin is smaller than the end, but step is negative");
    }
  }
  return Value::range(begin, step.as_number(), end);
}

// --- Vectors ----------------------------------------------------------------

Value run_vector(const Expression& expression, Frame& frame) {
  const auto& code = as<VectorCode>(expression);
  VectorBuilder out(code.elements.size());
  for (const Element* element : code.elements) {
    element->emit(*element, frame, out);
  }
  return out.finish();
}

void emit_value(const Element& element, Frame& frame, VectorBuilder& out) {
  out.push_made([&] { return run(element.value, frame); });
}

namespace {

void emit(const Element& element, Frame& frame, VectorBuilder& out) {
  if (element.emit == emit_value) {
    emit_value(element, frame, out);
  } else {
    element.emit(element, frame, out);
  }
}

constexpr std::uint32_t kMostElements = 1000000;

// Calls `give` for each value that `for` and `each` see in `values`.
template <typename Give>
void for_each_value(const Value& values, SourceRange range, Frame& frame,
                    const Give& give) {
  switch (values.type()) {
    case Type::kRange: {
      const Range& r = values.as_range();
      const std::uint32_t count = r.count();
      if (count >= kMostElements) {
        warn(frame, range,
             fmt::format("Bad range parameter in for statement: too many "
                         "elements ({})",
                         count));
        return;
      }
      if (r.step == 0) return;
      for (std::uint32_t i = 0; i < count; ++i) give(Value(r.at(i)));
      return;
    }
    case Type::kVector:
      for (const Value& value : values.as_vector()) give(Value(value));
      return;
    case Type::kObject:
      for (const Value& key : values.as_object().keys.as_vector()) {
        give(Value(key));
      }
      return;
    case Type::kString: {
      const std::uint32_t count = values.character_count();
      for (std::uint32_t i = 0; i < count; ++i) give(values.character(i));
      return;
    }
    case Type::kUnset:
    case Type::kUndef:
      return;
    default:
      give(Value(values));
  }
}

// How many values that will be, as far as it is cheap to know.
std::size_t count_values(const Value& values) {
  if (values.is_vector()) return values.as_vector().size();
  if (values.is_range()) {
    const std::uint32_t count = values.as_range().count();
    return count < kMostElements ? count : 0;
  }
  return 1;
}

// A fresh box for a variable that closures share.
void prepare(const Target& target, Frame& frame) {
  if (target.variable != nullptr && target.variable->is_boxed) {
    frame.slots[target.index] = frame.in.make_box();
  }
}

}  // namespace

void emit_for(const Element& element, Frame& frame, VectorBuilder& out) {
  const auto& code = static_cast<const ForElement&>(element);
  const Value values = run(code.binding.value, frame);
  const Target& target = code.binding.target;
  prepare(target, frame);
  if (code.body->emit == emit_value) {
    out.make_room(count_values(values));
  }
  const DynamicScope scope(frame.in);
  for_each_value(values, element.range, frame, [&](Value value) {
    frame.in.unwind(scope.mark());
    frame.in.assign(target, std::move(value), frame);
    emit(*code.body, frame, out);
  });
}

void emit_for_c(const Element& element, Frame& frame, VectorBuilder& out) {
  const auto& code = static_cast<const ForCElement&>(element);
  const DynamicScope scope(frame.in);
  for (const auto& [from, to] : code.copies) {
    frame.slots[to.index] = Value::unset();
    prepare(to, frame);
  }
  run_bindings(code.init, frame);
  std::uint32_t rounds = 0;
  while (is_true(code.condition, frame)) {
    emit(*code.body, frame, out);
    if (rounds++ == kMostElements) {
      frame.in.fail(element.range, "For loop counter exceeded limit",
                    frame.document);
    }
    const DynamicScope update(frame.in);
    run_bindings(code.update, frame);
    for (const auto& [from, to] : code.copies) {
      const Value& value = frame.slots[from.index];
      Value copy = value.type() == Type::kBox ? value.as_box().value : value;
      frame.in.assign(to, std::move(copy), frame);
    }
  }
}

void emit_if(const Element& element, Frame& frame, VectorBuilder& out) {
  const auto& code = static_cast<const IfElement&>(element);
  const Element* branch =
      is_true(code.condition, frame) ? code.if_true : code.if_false;
  if (branch != nullptr) emit(*branch, frame, out);
}

void emit_each(const Element& element, Frame& frame, VectorBuilder& out) {
  const auto& code = static_cast<const EachElement&>(element);
  const auto spread = [&](const Value& value) {
    if (value.is_vector()) {
      out.push_all(value.as_vector());
    } else if (value.is_object()) {
      out.push(value);  // `for` sees its keys, `each` the object
    } else {
      for_each_value(value, element.range, frame,
                     [&](Value one) { out.push(std::move(one)); });
    }
  };
  if (code.body->emit == emit_value) {
    Value spill;
    spread(look(code.body->value, frame, spill));
    return;
  }
  VectorBuilder inner;
  emit(*code.body, frame, inner);
  for (const Value& value : inner.values()) spread(value);
}

void emit_let(const Element& element, Frame& frame, VectorBuilder& out) {
  const auto& code = static_cast<const LetElement&>(element);
  const DynamicScope scope(frame.in);
  run_bindings(code.bindings, frame);
  emit(*code.body, frame, out);
}

// --- let, echo, assert ------------------------------------------------------

void run_bindings(Bindings bindings, Frame& frame) {
  for (const Binding& binding : bindings) prepare(binding.target, frame);
  for (const Binding& binding : bindings) {
    Value value = run(binding.value, frame);
    if (binding.target.kind != Target::Kind::kNowhere) [[likely]] {
      frame.in.assign(binding.target, std::move(value), frame);
    } else if (binding.name.empty()) {
      warn(frame, binding.range,
           "Assignment without variable name " + to_echo(value));
    } else {
      warn(frame, binding.range,
           fmt::format("Ignoring duplicate variable assignment {} = {}",
                       binding.name, to_echo(value)));
    }
  }
}

Value run_let(const Expression& expression, Frame& frame) {
  const auto& code = as<LetCode>(expression);
  const DynamicScope scope(frame.in);
  run_bindings(code.bindings, frame);
  return run(code.body, frame);
}

std::string echo_text(std::span<const WrittenArgument> arguments,
                      Frame& frame) {
  std::string text;
  for (const WrittenArgument& argument : arguments) {
    if (&argument != arguments.data()) text += ", ";
    if (!argument.name.empty()) {
      text += argument.name;
      text += " = ";
    }
    append_echo(run(argument.value, frame), text);
  }
  return text;
}

Value run_echo(const Expression& expression, Frame& frame) {
  const auto& code = as<EchoCode>(expression);
  frame.in.echo(echo_text(code.arguments, frame));
  return code.body != nullptr ? run(code.body, frame) : Value();
}

void run_assert(const AssertCode& code, Frame& frame) {
  for (const std::string& warning : code.plan->warnings) {
    warn(frame, code.range, warning);
  }
  const Value condition = run(code.condition, frame);
  const Value message = run(code.message, frame);
  if (condition.is_true()) return;
  std::string text = "Assertion";
  if (code.condition_text != nullptr) {
    text += " '" + expression_text(*code.condition_text) + "'";
  }
  text += " failed";
  if (!message.is_undef()) text += ": " + to_echo(message);
  frame.in.fail(code.range, std::move(text), frame.document);
}

Value run_assert_expression(const Expression& expression, Frame& frame) {
  const auto& code = as<AssertCode>(expression);
  run_assert(code, frame);
  return code.body != nullptr ? run(code.body, frame) : Value();
}

// --- Functions --------------------------------------------------------------

Value run_function_literal(const Expression& expression, Frame& frame) {
  const FunctionLiteral& literal = *as<LiteralCode>(expression).literal;
  auto* closure = new Closure;
  closure->code = &literal;
  closure->link = literal.hops == 0 ? &frame : frame.link;
  closure->captured.reserve(literal.captures.size());
  for (const FunctionLiteral::Capture& capture : literal.captures) {
    closure->captured.push_back(capture.from_closure
                                    ? frame.closure->captured[capture.index]
                                    : frame.slots[capture.index]);
  }
  return Value::adopt(Type::kFunction, closure, 0);
}

std::string FunctionLiteral::text() const {
  std::string text = "function(";
  for (const ast::Argument& parameter : definition->parameters) {
    if (&parameter != definition->parameters.data()) text += ", ";
    text += parameter.name;
    if (parameter.value != nullptr) {
      text += " = " + expression_text(*parameter.value);
    }
  }
  return text + ") " + expression_text(*definition->body);
}

namespace {

void warn_of_arguments(const ArgumentPlan& plan, SourceRange range,
                       Frame& caller, Repeats repeats) {
  if (plan.warnings.empty()) return;
  if (repeats == Repeats::kSilent && !caller.in.is_first_of_call(range)) return;
  for (const std::string& warning : plan.warnings) warn(caller, range, warning);
}

}  // namespace

void pass_arguments(const ArgumentPlan& plan,
                    std::span<const Parameter> parameters,
                    std::span<const WrittenArgument> arguments,
                    SourceRange range, Frame& caller, Frame& callee,
                    Repeats repeats) {
  for (const std::uint32_t i : plan.defaults) {
    const Parameter& parameter = parameters[i];
    Value value =
        parameter.fallback ? run(parameter.fallback, callee) : Value();
    callee.in.assign(parameter.target, std::move(value), callee);
  }
  warn_of_arguments(plan, range, caller, repeats);
  for (const BoundArgument& bound : plan.bound) {
    Value value = run(arguments[bound.written].value, caller);
    callee.in.assign(bound.target, std::move(value), callee);
  }
}

namespace {

// `$` variables that a tail call's arguments and enclosing lets bind stay
// bound; everything else of the frame is overwritten.
void jump(const CallCode& call, const ArgumentPlan& plan,
          std::span<const BoundArgument> bound, std::size_t trail_mark,
          Frame& frame) {
  warn_of_arguments(plan, call.range, frame, Repeats::kSilent);
  const auto count = static_cast<std::uint32_t>(bound.size());
  Frame scratch{frame.in};
  Value* memory = LAMINA_FRAME_MEMORY(count);
  const FrameSlots values(scratch, memory, count);
  for (std::uint32_t i = 0; i < count; ++i) {
    memory[i] = run(call.arguments[bound[i].written].value, frame);
  }
  const auto store = [&](const Target& target, Value value) {
    if (target.kind == Target::Kind::kDynamic) {
      frame.in.rebind_dynamic(target.index, std::move(value), trail_mark);
    } else {
      frame.in.assign(target, std::move(value), frame);
    }
  };
  if (call.tail_defaults != nullptr) {
    for (const CallCode::TailDefault& fallback : *call.tail_defaults) {
      if (fallback.cached.is_unset()) {
        fallback.cached = run(fallback.value, frame);
      }
      store(fallback.target, fallback.cached);
    }
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    store(bound[i].target, std::move(memory[i]));
  }
}

// A tail call of a function literal by the name that it was called by is a
// jump if that name still means the same literal.
bool jump_to_literal(const CallCode& call, const Callable& callable,
                     std::string_view name, std::size_t trail_mark,
                     Frame& frame) {
  if (call.callee == nullptr || call.name != name) return false;
  if (frame.closure->method != nullptr) return false;
  const Value callee = run(call.callee, frame);
  if (!callee.is_function() || &callee.as_function() != frame.closure) {
    return false;
  }
  const auto& here = static_cast<const FunctionLiteral&>(callable);
  const auto& [literal, plan] = frame.in.plan_for(call, here);
  if (literal != &here || !plan.defaults.empty()) return false;
  jump(call, plan, plan.bound, trail_mark, frame);
  return true;
}

// Follows the tail positions of a body. True: start again.
bool run_round(const Callable& callable, std::string_view name,
               std::size_t trail_mark, Frame& frame, Value& result) {
  const Expression* code = callable.body;
  while (true) {
    switch (code->kind) {
      case Expression::Kind::kConditional: {
        const auto& conditional = as<ConditionalCode>(*code);
        code = is_true(conditional.condition, frame) ? conditional.if_true
                                                     : conditional.if_false;
        break;
      }
      case Expression::Kind::kLet:
        run_bindings(as<LetCode>(*code).bindings, frame);
        code = as<LetCode>(*code).body;
        break;
      case Expression::Kind::kAssert:
        run_assert(as<AssertCode>(*code), frame);
        code = as<AssertCode>(*code).body;
        break;
      case Expression::Kind::kEcho:
        frame.in.echo(echo_text(as<EchoCode>(*code).arguments, frame));
        code = as<EchoCode>(*code).body;
        break;
      case Expression::Kind::kTailCall: {
        const auto& call = as<CallCode>(*code);
        if (call.tail_defaults != nullptr) {
          jump(call, *call.plan, call.tail_arguments, trail_mark, frame);
          return true;
        }
        if (jump_to_literal(call, callable, name, trail_mark, frame)) {
          return true;
        }
        result = run(code, frame);
        return false;
      }
      default:
        result = run(code, frame);
        return false;
    }
    if (code == nullptr) {
      result = Value();
      return false;
    }
  }
}

}  // namespace

Value run_body(const Callable& callable, std::string_view name,
               SourceRange range, Frame& frame) {
  if (!callable.has_tail_calls) return run(callable.body, frame);
  constexpr std::uint32_t kMostTailCalls = 1000000;
  const std::size_t trail_mark = frame.in.trail_size();
  Value result;
  std::uint32_t rounds = 0;
  while (run_round(callable, name, trail_mark, frame, result)) {
    if (rounds++ == kMostTailCalls) {
      frame.in.fail_recursion(range, "function", name, frame.document);
    }
  }
  return result;
}

// --- Calls ------------------------------------------------------------------

// Made when it is asked for: in f(1)(2)(3)… every callee holds all before it.
std::string shown_name(const CallCode& code) {
  return code.callee_text == nullptr
             ? std::string(code.name)
             : fmt::format("({})", expression_text(*code.callee_text));
}

namespace {

Value call_function(const CallCode& code, Frame& frame) {
  Function& function = *code.function;
  if (function.body == nullptr) {
    frame.in.resolver().resolve(function);
    frame.in.grow_dynamic();
  }
  const DynamicScope scope(frame.in);
  Frame callee{frame.in};
  callee.document = function.unit->document;
  if (code.is_foreign) {
    callee.link = &frame.in.enter_unit(*function.unit);
  } else {
    callee.link = &frame;
    for (std::uint32_t i = 0; i < code.hops; ++i) {
      callee.link = callee.link->link;
    }
  }
  Value* memory = LAMINA_FRAME_MEMORY(function.slot_count);
  const FrameSlots slots(callee, memory, function.slot_count);
  pass_arguments(*code.plan, function.parameters, code.arguments, code.range,
                 frame, callee,
                 code.is_self_call ? Repeats::kSilent : Repeats::kTold);
  return run_body(function, function.name, function.range, callee);
}

// The parameter `this` of a method is its object, whatever else was given.
[[gnu::noinline]] void pass_this(const Closure& closure, Frame& callee) {
  for (const Parameter& parameter : closure.code->parameters) {
    if (parameter.name != "this") continue;
    callee.in.assign(parameter.target, Value(closure.method->object), callee);
  }
}

// The callee holds a function; `function` keeps it alive.
Value call_closure(const CallCode& code, const Value& function, Frame& frame) {
  const Closure& closure = function.as_function();
  const auto& [literal, plan] = frame.in.plan_for(code, *closure.code);
  const Callable& callable = *literal;
  const DynamicScope scope(frame.in);
  Frame callee{frame.in};
  callee.link = closure.link;
  callee.closure = &closure;
  callee.document = literal->document;
  Value* memory = LAMINA_FRAME_MEMORY(callable.slot_count);
  const FrameSlots slots(callee, memory, callable.slot_count);
  const bool is_self_call =
      code.kind == Expression::Kind::kTailCall && frame.closure == &closure;
  pass_arguments(plan, callable.parameters, code.arguments, code.range, frame,
                 callee, is_self_call ? Repeats::kSilent : Repeats::kTold);
  if (closure.method != nullptr) [[unlikely]]
    pass_this(closure, callee);
  return run_body(callable, code.name, code.range, callee);
}

Value call_builtin(const CallCode& code, Frame& frame) {
  if (code.math != nullptr) return call_math(code, frame);
  return code.builtin(code, frame);
}

Value report_unknown(const CallCode& code, Frame& frame) {
  frame.in.warn(code.range,
                fmt::format("Ignoring unknown function '{}'", code.name));
  return Value();
}

}  // namespace

Value run_call_function(const Expression& expression, Frame& frame) {
  const auto& code = as<CallCode>(expression);
  frame.in.check_depth(code.range, "function", code.name, frame.document);
  const ActiveCall active(code, frame);
  return call_function(code, frame);
}

Value run_call_math(const Expression& expression, Frame& frame) {
  const auto& code = as<CallCode>(expression);
  const ActiveCall active(code, frame);
  return call_math(code, frame);
}

Value run_call_builtin(const Expression& expression, Frame& frame) {
  const auto& code = as<CallCode>(expression);
  frame.in.check_depth(code.range, "function", code.name, frame.document);
  const ActiveCall active(code, frame);
  return call_builtin(code, frame);
}

Value run_call_unknown(const Expression& expression, Frame& frame) {
  const auto& code = as<CallCode>(expression);
  const ActiveCall active(code, frame);
  return report_unknown(code, frame);
}

Value run_call_value(const Expression& expression, Frame& frame) {
  const auto& code = as<CallCode>(expression);
  if (frame.in.is_too_deep()) {
    frame.in.fail_recursion(code.range, "function", shown_name(code),
                            frame.document);
  }
  const ActiveCall active(code, frame);
  const Value callee = run(code.callee, frame);
  if (callee.is_function()) {
    if (code.is_name && code.name[0] == '$') {
      warn(frame, code.range,
           "Can't call function on dynamically scoped variable");
      return Value();
    }
    return call_closure(code, callee, frame);
  }
  if (!code.is_name) {
    warn(frame, code.range,
         fmt::format("Can't call function on {}", type_name(callee.type())));
    return Value();
  }
  if (code.function != nullptr) return call_function(code, frame);
  if (code.builtin != nullptr || code.math != nullptr) {
    return call_builtin(code, frame);
  }
  return report_unknown(code, frame);
}

}  // namespace lamina::csg
