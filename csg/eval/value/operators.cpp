#include "csg/eval/value/operators.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <string_view>
#include <utility>

#include "csg/eval/value/object.h"
#include "parser/ast_printer.h"

namespace lamina::csg {

namespace {

using ast::BinaryOp;

// --- Arithmetic -----------------------------------------------------------

// The vector of `result_of` of the first `count` elements; in place where no
// other value holds them all.
template <typename ResultOf>
Value map_elements(Value&& vector, std::size_t count,
                   const ResultOf& result_of) {
  const std::span<Value> own = vector.own_elements();
  if (own.size() == count && count > 0) {
    for (std::size_t i = 0; i < count; ++i) {
      own[i] = result_of(i, std::move(own[i]));
    }
    return std::move(vector);
  }
  const std::span<const Value> elements = vector.as_vector();
  VectorBuilder result(count);
  for (std::size_t i = 0; i < count; ++i) {
    result.push(result_of(i, Value(elements[i])));
  }
  return result.finish();
}

// Vectors of vectors that several values hold, and what an operator has made of
// them: where operands share, results share too. Otherwise [v, v], doubled 30
// times, would cost a billion vectors. Operands are kept, so that no other
// vector gets their place.
class SharedResults {
 public:
  // Whether it pays to ask for them.
  static bool may_recur(const Value& operand) {
    return operand.is_shared_vector() && !operand.as_vector().empty() &&
           operand.as_vector().front().is_vector();
  }

  // of    one operand or two: undef where there is one only
  // make  the result, where it is not known
  template <typename Make>
  Value get(const Value& a, const Value& b, const Make& make) {
    const Key key = {key_of(a), key_of(b)};
    if (const auto known = results_.find(key); known != results_.end()) {
      return known->second.result;
    }
    Known fresh{a, b, Value()};
    fresh.result = make();
    return results_.emplace(key, std::move(fresh)).first->second.result;
  }

 private:
  using VectorKey = std::pair<const Value*, std::size_t>;
  using Key = std::pair<VectorKey, VectorKey>;
  struct Known {
    Value a;
    Value b;
    Value result;
  };

  static VectorKey key_of(const Value& value) {
    const std::span<const Value> elements = value.elements();
    return {elements.data(), elements.size()};
  }

  std::map<Key, Known> results_;
};

// `of` of each number in a vector of vectors of numbers; undef for all else in
// it.
template <typename Of>
Value map_numbers(Value&& value, const Of& of, SharedResults& shared) {
  if (value.is_number()) return Value(of(value.as_number()));
  if (!value.is_vector()) return Value();
  const auto map = [&](Value&& vector) {
    const std::size_t count = vector.as_vector().size();
    return map_elements(std::move(vector), count,
                        [&](std::size_t, Value&& element) {
                          return map_numbers(std::move(element), of, shared);
                        });
  };
  if (!SharedResults::may_recur(value)) return map(std::move(value));
  return shared.get(value, Value(), [&] { return map(Value(value)); });
}

template <typename Of>
Value map_numbers(Value&& vector, const Of& of) {
  SharedResults shared;
  return map_numbers(std::move(vector), of, shared);
}

// `of` each pair of numbers of two vectors, as far as the shorter one goes.
template <typename Of>
Value zip_numbers(Value&& left, Value&& right, const Of& of,
                  SharedResults& shared) {
  if (left.is_number() && right.is_number()) {
    return Value(of(left.as_number(), right.as_number()));
  }
  if (!left.is_vector() || !right.is_vector()) return Value();
  const auto zip = [&](Value&& x, Value&& y) {
    const std::span<const Value> a = x.as_vector();
    const std::span<const Value> b = y.as_vector();
    const std::size_t count = std::min(a.size(), b.size());
    if (y.own_elements().size() == count) {
      return map_elements(
          std::move(y), count, [&](std::size_t i, Value&& element) {
            return zip_numbers(Value(a[i]), std::move(element), of, shared);
          });
    }
    return map_elements(
        std::move(x), count, [&](std::size_t i, Value&& element) {
          return zip_numbers(std::move(element), Value(b[i]), of, shared);
        });
  };
  if (!SharedResults::may_recur(left) || !SharedResults::may_recur(right)) {
    return zip(std::move(left), std::move(right));
  }
  return shared.get(left, right,
                    [&] { return zip(Value(left), Value(right)); });
}

// Inlined for the sake of numbers, the elements of most vectors.
[[gnu::always_inline]] inline Value add_or_subtract(BinaryOp op, Value&& left,
                                                    Value&& right,
                                                    Reason& reason) {
  if (left.is_number() && right.is_number()) {
    return Value(op == BinaryOp::kAdd ? left.as_number() + right.as_number()
                                      : left.as_number() - right.as_number());
  }
  if (!left.is_vector() || !right.is_vector()) {
    return undefined(op, left, right, reason);
  }
  SharedResults shared;
  return op == BinaryOp::kAdd ? zip_numbers(std::move(left), std::move(right),
                                            std::plus<double>(), shared)
                              : zip_numbers(std::move(left), std::move(right),
                                            std::minus<double>(), shared);
}

Value multiply_any(Value&& left, Value&& right, Reason& reason);

[[gnu::always_inline]] inline Value multiply(Value&& left, Value&& right,
                                             Reason& reason) {
  if (left.is_number() && right.is_number()) {
    return Value(left.as_number() * right.as_number());
  }
  return multiply_any(std::move(left), std::move(right), reason);
}

Value multiply_any(Value&& left, Value&& right, Reason& reason) {
  if (left.is_vector() && right.is_number()) {
    return map_numbers(std::move(left), [factor = right.as_number()](double x) {
      return x * factor;
    });
  }
  if (left.is_number() && right.is_vector()) {
    return map_numbers(std::move(right), [factor = left.as_number()](double x) {
      return x * factor;
    });
  }
  if (left.is_vector() && right.is_vector()) {
    return multiply_vectors(left.as_vector(), right.as_vector(), reason);
  }
  return undefined(BinaryOp::kMultiply, left, right, reason);
}

Value divide(Value&& left, Value&& right, Reason& reason) {
  if (left.is_number() && right.is_number()) {
    return Value(left.as_number() / right.as_number());
  }
  if (left.is_vector() && right.is_number()) {
    return map_numbers(std::move(left), [divisor = right.as_number()](
                                            double x) { return x / divisor; });
  }
  if (left.is_number() && right.is_vector()) {
    return map_numbers(
        std::move(right),
        [dividend = left.as_number()](double x) { return dividend / x; });
  }
  return undefined(BinaryOp::kDivide, left, right, reason);
}

// --- Bits -------------------------------------------------------------------

// Bitwise operators see numbers cut to integers of 64 bits in two's complement.
Value apply_bitwise(BinaryOp op, double left, double right, Reason& reason) {
  const std::int64_t a = cut_to<std::int64_t>(left);
  const std::int64_t b = cut_to<std::int64_t>(right);
  const bool is_shift =
      op == BinaryOp::kShiftLeft || op == BinaryOp::kShiftRight;
  if (is_shift && (b < 0 || b >= 64)) {
    return undefined_because(reason, "{}",
                             b < 0 ? "negative shift" : "shift too large");
  }
  switch (op) {
    case BinaryOp::kBitOr:
      return Value(static_cast<double>(a | b));
    case BinaryOp::kBitAnd:
      return Value(static_cast<double>(a & b));
    case BinaryOp::kShiftLeft:
      return Value(static_cast<double>(a << b));
    default:
      assert(op == BinaryOp::kShiftRight);
      return Value(static_cast<double>(a >> b));
  }
}

Value invert(const Value& value, Reason& reason) {
  if (value.is_number()) {
    return Value(static_cast<double>(~cut_to<std::int64_t>(value.as_number())));
  }
  return undefined_because(reason, "undefined operation (~{})",
                           type_name(value.type()));
}

}  // namespace

Value undefined(BinaryOp op, const Value& left, const Value& right,
                Reason& reason) {
  return undefined_because(reason, "undefined operation ({} {} {})",
                           type_name(left.type()), ast::symbol(op),
                           type_name(right.type()));
}

Value apply_binary(BinaryOp op, Value left, Value right, Reason& reason) {
  switch (op) {
    case BinaryOp::kEqual:
      return Value(are_equal(left, right));
    case BinaryOp::kNotEqual:
      return Value(!are_equal(left, right));
    case BinaryOp::kLess:
    case BinaryOp::kLessEqual:
    case BinaryOp::kGreater:
    case BinaryOp::kGreaterEqual:
      return compare(op, left, right, reason);
    case BinaryOp::kAdd:
    case BinaryOp::kSubtract:
      return add_or_subtract(op, std::move(left), std::move(right), reason);
    case BinaryOp::kMultiply:
      return multiply(std::move(left), std::move(right), reason);
    case BinaryOp::kDivide:
      return divide(std::move(left), std::move(right), reason);
    default:
      break;
  }
  if (!left.is_number() || !right.is_number()) {
    return undefined(op, left, right, reason);
  }
  const double a = left.as_number();
  const double b = right.as_number();
  if (op == BinaryOp::kModulo) return Value(modulo(a, b));
  if (op == BinaryOp::kPower) return Value(std::pow(a, b));
  return apply_bitwise(op, a, b, reason);
}

Value apply_unary(ast::UnaryOp op, Value value, Reason& reason) {
  switch (op) {
    case ast::UnaryOp::kNot:
      return Value(!value.is_true());
    case ast::UnaryOp::kNegate:
      return negate(std::move(value), reason);
    case ast::UnaryOp::kBitNot:
      return invert(value, reason);
  }
  return Value();
}

Value negate(Value value, Reason& reason) {
  if (value.is_number()) return Value(-value.as_number());
  if (value.is_vector()) {
    return map_numbers(std::move(value), std::negate<double>());
  }
  return undefined_because(reason, "undefined operation (-{})",
                           type_name(value.type()));
}

Value index(const Value& object, const Value& index) {
  if (object.is_object() && index.is_string()) {
    return find_member(object, index.as_string());
  }
  if (!index.is_number()) return Value();
  const double number = index.as_number();
  // Cut towards zero, so -0.5 is the first element; no number beyond 32 bits
  // is an index.
  if (!(number > -1) || number > std::numeric_limits<std::uint32_t>::max()) {
    return Value();
  }
  const auto i = static_cast<std::uint32_t>(number);
  switch (object.type()) {
    case Type::kVector: {
      const std::span<const Value> elements = object.as_vector();
      return i < elements.size() ? elements[i] : Value();
    }
    case Type::kString:
      if (i < object.as_string().size() && i < object.character_count()) {
        return object.character(i);
      }
      return Value();
    case Type::kRange: {
      const Range& range = object.as_range();
      if (i == 0) return Value(range.begin);
      if (i == 1) return Value(range.step);
      if (i == 2) return Value(range.end);
      return Value();
    }
    default:
      return Value();
  }
}

namespace {

// Elements by the letters of coordinates or of colours, not both at once.
Value swizzle(std::span<const Value> elements, std::string_view letters) {
  constexpr std::size_t kMostLetters = 4;
  if (letters.empty() || letters.size() > kMostLetters) return Value();
  const bool is_colour =
      std::string_view("rgba").find(letters[0]) != std::string_view::npos;
  const std::string_view axes = is_colour ? "rgba" : "xyzw";
  VectorBuilder result(letters.size());
  for (const char letter : letters) {
    const std::size_t i = axes.find(letter);
    if (i == std::string_view::npos) return Value();
    result.push(i < elements.size() ? elements[i] : Value());
  }
  return result.size() == 1 ? result.values()[0] : result.finish();
}

}  // namespace

Value member(const Value& object, std::string_view name) {
  // v.x, v.y and v.z are most of all members.
  if (object.is_vector() && name.size() == 1 && name[0] >= 'x' &&
      name[0] <= 'z') {
    return index(object, Value(static_cast<double>(name[0] - 'x')));
  }
  if (object.is_vector()) return swizzle(object.as_vector(), name);
  if (object.is_object()) return find_member(object, name);
  if (object.is_range()) {
    const Range& range = object.as_range();
    if (name == "begin") return Value(range.begin);
    if (name == "step") return Value(range.step);
    if (name == "end") return Value(range.end);
  }
  return Value();
}

}  // namespace lamina::csg
