// Running operators (see expression.h).

#include <cmath>

#include "csg/eval/run/expression.h"
#include "csg/eval/run/interpreter.h"
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

template <BinaryOp op>
Value on_numbers(double a, double b) {
  if constexpr (op == BinaryOp::kEqual) {
    return Value(a == b);
  } else if constexpr (op == BinaryOp::kNotEqual) {
    return Value(a != b);
  } else if constexpr (op == BinaryOp::kLess) {
    return Value(a < b);
  } else if constexpr (op == BinaryOp::kLessEqual) {
    return Value(a <= b);
  } else if constexpr (op == BinaryOp::kGreater) {
    return Value(a > b);
  } else if constexpr (op == BinaryOp::kGreaterEqual) {
    return Value(a >= b);
  } else if constexpr (op == BinaryOp::kAdd) {
    return Value(a + b);
  } else if constexpr (op == BinaryOp::kSubtract) {
    return Value(a - b);
  } else if constexpr (op == BinaryOp::kMultiply) {
    return Value(a * b);
  } else if constexpr (op == BinaryOp::kDivide) {
    return Value(a / b);
  } else if constexpr (op == BinaryOp::kModulo) {
    return Value(modulo(a, b));
  } else {
    static_assert(op == BinaryOp::kPower);
    return Value(std::pow(a, b));
  }
}

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

template <Reach reach>
class Operand {
 public:
  Operand(const Expression* code, Frame& frame)
      : value_(look(code, frame, spill_)) {}
  const Value& value() const { return value_; }
  Value take() { return csg::take(value_, spill_); }

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
  Value take() { return csg::take(value_, spill_); }

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
template <BinaryOp op, Reach left_reach, Reach right_reach>
Value run_binary(const Expression& expression, Frame& frame) {
  const auto& code = as<BinaryCode>(expression);
  Operand<right_reach> right(code.right, frame);
  Operand<left_reach> left(code.left, frame);
  const Value& a = left.value();
  const Value& b = right.value();
  if (a.is_number() && b.is_number()) [[likely]] {
    return on_numbers<op>(a.as_number(), b.as_number());
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

template <BinaryOp op, Reach left>
Expression::Runner runner_for(const Expression& right) {
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
Expression::Runner runner_for(const Expression& left, const Expression& right) {
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

Expression::Runner binary_runner(BinaryOp op, const Expression& left,
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

}  // namespace lamina::csg
