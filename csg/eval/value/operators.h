#pragma once
// The operators on values, with OpenSCAD's rules for mixed types.
//
// Where an operation has no meaning the result is undef and the reason is
// left in `reason`, in the words of OpenSCAD's warning. An undef inside a
// resulting vector has no reason: OpenSCAD keeps quiet about those.

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "csg/eval/value/value.h"
#include "parser/ast.h"

namespace lamina::csg {

// Why an operation has no meaning, in the words of OpenSCAD's warning; empty
// where it has one.
struct Reason {
  std::string text;
  // What OpenSCAD warns of before, naming no place; mostly empty.
  std::string said_before;
};

// undef; leaves the words in `reason`.
template <typename... Parts>
Value undefined_because(Reason& reason, fmt::format_string<Parts...> words,
                        Parts&&... parts) {
  reason.text = fmt::format(words, std::forward<Parts>(parts)...);
  return Value();
}
// undef; leaves "undefined operation (number + string)" in `reason`.
Value undefined(ast::BinaryOp op, const Value& left, const Value& right,
                Reason& reason);

// left == right; never undefined.
bool are_equal(const Value& left, const Value& right);

// left < right, false where that is undefined (min, max and search use it).
bool is_less(const Value& left, const Value& right);

// By `<`, `<=`, `>` or `>=`; undef with its reason where values do not compare.
Value compare(ast::BinaryOp op, const Value& left, const Value& right,
              Reason& reason);

// The dot product of two vectors, or the product of a matrix (a vector of
// vectors) and a vector or a matrix: what is meant depends on the first
// elements. undef with its reason where sizes or elements do not fit.
Value multiply_vectors(std::span<const Value> a, std::span<const Value> b,
                       Reason& reason);

// Cut towards zero. What does not fit becomes the least integer, as on x86; C++
// leaves that undefined.
template <typename Integer>
Integer cut_to(double number) {
  constexpr Integer kLeast = std::numeric_limits<Integer>::min();
  return std::fabs(number) < -static_cast<double>(kLeast)
             ? static_cast<Integer>(number)
             : kLeast;
}

// std::fmod, quicker where both are whole numbers, as they mostly are.
inline double modulo(double a, double b) {
  constexpr double kWhole = 0x1p53;
  if (std::fabs(a) < kWhole && std::fabs(b) < kWhole && b != 0) {
    const auto i = static_cast<std::int64_t>(a);
    const auto k = static_cast<std::int64_t>(b);
    if (static_cast<double>(i) == a && static_cast<double>(k) == b) {
      return std::copysign(static_cast<double>(i % k), a);
    }
  }
  return std::fmod(a, b);
}

// All but `&&` and `||`, which do not evaluate both sides. A vector moved in
// that no other value holds may become the result: `[..] * 2 + [..]` makes two
// vectors, not four.
Value apply_binary(ast::BinaryOp op, Value left, Value right, Reason& reason);

Value apply_unary(ast::UnaryOp op, Value value, Reason& reason);
Value negate(Value value, Reason& reason);

// object[index], or object["name"] of an object; undef without a word where
// it has no such element.
Value index(const Value& object, const Value& index);

// object.name: a member of an object; begin, step, end of a range; of a vector
// one of xyzw or rgba (its first four elements), or a vector of up to four from
// one of the two.
Value member(const Value& object, std::string_view name);

}  // namespace lamina::csg
