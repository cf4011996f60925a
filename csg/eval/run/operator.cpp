// Running operators (see runners.h).

#include <cmath>
#include <functional>

#include "csg/eval/run/interpreter.h"
#include "csg/eval/run/runners.h"
#include "csg/eval/value/operators.h"

namespace lamina::csg {

namespace {

using ast::BinaryOp;

// The value that `look` found: moved if it is in the spill, else copied.
Value take(const Value& value, Value& spill) {
  if (&value == &spill) return std::move(spill);
  return value;
}

Value apply(ast::UnaryOp op, const Expression& expression, Value operand,
            Frame& frame) {
  Reason reason;
  Value result = apply_unary(op, std::move(operand), reason);
  if (!reason.text.empty())
    warn(frame, expression.range, std::move(reason.text));
  return result;
}

Value run_not(const Expression& expression, Frame& frame) {
  return Value(!is_true(as<UnaryCode>(expression).operand, frame));
}

Value run_negate(const Expression& expression, Frame& frame) {
  Value spill;
  const Value& operand = look(as<UnaryCode>(expression).operand, frame, spill);
  if (operand.is_number()) return Value(-operand.as_number());
  return apply(ast::UnaryOp::kNegate, expression, take(operand, spill), frame);
}

Value run_bit_not(const Expression& expression, Frame& frame) {
  return apply(ast::UnaryOp::kBitNot, expression,
               run(as<UnaryCode>(expression).operand, frame), frame);
}

}  // namespace

Expression::Runner unary_runner(ast::UnaryOp op) {
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

// What the operators without a functor in the standard library do to numbers.
struct Modulo {
  double operator()(double a, double b) const { return modulo(a, b); }
};
struct Power {
  double operator()(double a, double b) const { return std::pow(a, b); }
};

// How the value of an operand is reached. Most operands are plain variables,
// constants and results; the resolver knows which, so that running need not
// ask.
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

// Constants and results have operands of their own: neither has a spill to
// destroy, and a result is made where it stays.
template <Reach reach>
class Operand {
 public:
  Operand(const Expression* code, Frame& frame) : value_(find(code, frame)) {}
  const Value& value() const { return value_; }
  Value take() { return csg::take(value_, spill_); }

 private:
  const Value& find(const Expression* code, Frame& frame) {
    if constexpr (reach == Reach::kLocal) {
      const Value& local = frame.slots[code->slot];
      return is_plain(local) ? local : look_further(code, frame, spill_);
    } else {
      return look(code, frame, spill_);
    }
  }

  Value spill_;
  const Value& value_;
};
template <>
class Operand<Reach::kConstant> {
 public:
  Operand(const Expression* code, Frame&)
      : value_(*as<Constant>(*code).value) {}
  const Value& value() const { return value_; }
  Value take() { return value_; }

 private:
  const Value& value_;
};
template <>
class Operand<Reach::kComputed> {
 public:
  Operand(const Expression* code, Frame& frame) : value_(run(code, frame)) {}
  const Value& value() const { return value_; }
  Value take() { return std::move(value_); }

 private:
  Value value_;
};

// Applies a binary operator to operands that are not both numbers, or to bits.
template <typename Left, typename Right>
[[gnu::noinline]] Value run_binary_any(const BinaryCode& code, Left& left,
                                       Right& right, Frame& frame) {
  Reason reason;
  Value result = apply_binary(code.op, left.take(), right.take(), reason);
  if (!reason.said_before.empty()) {
    warn(frame, {}, std::move(reason.said_before));
  }
  if (!reason.text.empty()) warn(frame, code.range, std::move(reason.text));
  return result;
}

// Evaluates the right operand first, as the released openscad does: that is the
// order of their messages.
template <typename OnNumbers, Reach left_reach, Reach right_reach>
Value run_binary(const Expression& expression, Frame& frame) {
  const auto& code = as<BinaryCode>(expression);
  Operand<right_reach> right(code.right, frame);
  Operand<left_reach> left(code.left, frame);
  const Value& a = left.value();
  const Value& b = right.value();
  if (a.is_number() && b.is_number()) [[likely]] {
    return Value(OnNumbers()(a.as_number(), b.as_number()));
  }
  return run_binary_any(code, left, right, frame);
}

Value run_bitwise(const Expression& expression, Frame& frame) {
  const auto& code = as<BinaryCode>(expression);
  Operand<Reach::kLooked> right(code.right, frame);
  Operand<Reach::kLooked> left(code.left, frame);
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

template <typename OnNumbers, Reach left>
Expression::Runner runner_for(const Expression& right) {
  switch (reach_of(right)) {
    case Reach::kLocal:
      return run_binary<OnNumbers, left, Reach::kLocal>;
    case Reach::kConstant:
      return run_binary<OnNumbers, left, Reach::kConstant>;
    case Reach::kComputed:
      return run_binary<OnNumbers, left, Reach::kComputed>;
    default:
      return run_binary<OnNumbers, left, Reach::kLooked>;
  }
}
template <typename OnNumbers>
Expression::Runner runner_for(const Expression& left, const Expression& right) {
  switch (reach_of(left)) {
    case Reach::kLocal:
      return runner_for<OnNumbers, Reach::kLocal>(right);
    case Reach::kComputed:
      return runner_for<OnNumbers, Reach::kComputed>(right);
    default:
      return runner_for<OnNumbers, Reach::kLooked>(right);
  }
}

}  // namespace

Expression::Runner binary_runner(BinaryOp op, const Expression& left,
                                 const Expression& right) {
  switch (op) {
    case BinaryOp::kOr:
      return run_or;
    case BinaryOp::kAnd:
      return run_and;
    case BinaryOp::kEqual:
      return runner_for<std::equal_to<>>(left, right);
    case BinaryOp::kNotEqual:
      return runner_for<std::not_equal_to<>>(left, right);
    case BinaryOp::kLess:
      return runner_for<std::less<>>(left, right);
    case BinaryOp::kLessEqual:
      return runner_for<std::less_equal<>>(left, right);
    case BinaryOp::kGreater:
      return runner_for<std::greater<>>(left, right);
    case BinaryOp::kGreaterEqual:
      return runner_for<std::greater_equal<>>(left, right);
    case BinaryOp::kBitOr:
    case BinaryOp::kBitAnd:
    case BinaryOp::kShiftLeft:
    case BinaryOp::kShiftRight:
      return run_bitwise;
    case BinaryOp::kAdd:
      return runner_for<std::plus<>>(left, right);
    case BinaryOp::kSubtract:
      return runner_for<std::minus<>>(left, right);
    case BinaryOp::kMultiply:
      return runner_for<std::multiplies<>>(left, right);
    case BinaryOp::kDivide:
      return runner_for<std::divides<>>(left, right);
    case BinaryOp::kModulo:
      return runner_for<Modulo>(left, right);
    default:
      return runner_for<Power>(left, right);
  }
}

}  // namespace lamina::csg
