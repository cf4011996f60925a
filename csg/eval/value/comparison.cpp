// Comparing values (see operators.h).

#include <algorithm>
#include <optional>
#include <span>

#include "csg/eval/value/object.h"
#include "csg/eval/value/operators.h"
#include "parser/ast_printer.h"

namespace lamina::csg {

using ast::BinaryOp;

namespace {

bool are_equal_ranges(const Range& a, const Range& b) {
  const std::uint32_t n = a.count();
  if (n == 0 || b.count() == 0) return n == b.count();
  return a.begin == b.begin && a.step == b.step && n == b.count();
}

// a < b, or a <= b where equality is allowed.
bool is_less_range(const Range& a, const Range& b, bool or_equal) {
  const std::uint32_t n = a.count();
  const std::uint32_t m = b.count();
  if (n == 0) return or_equal || m > 0;
  if (m == 0) return false;
  if (a.begin != b.begin) return a.begin < b.begin;
  if (a.step != b.step) return a.step < b.step;
  return or_equal ? n <= m : n < m;
}

// Lexicographic; nothing where elements cannot be compared.
std::optional<bool> is_less_vector(std::span<const Value> a,
                                   std::span<const Value> b, Reason& reason) {
  const std::size_t common = std::min(a.size(), b.size());
  for (std::size_t i = 0; i < common; ++i) {
    const Value less = compare(BinaryOp::kLess, a[i], b[i], reason);
    if (less.is_undef()) {
      reason.text += fmt::format("\n\tin vector comparison at index {}", i);
      return std::nullopt;
    }
    if (less.is_true()) return true;
    if (is_less(b[i], a[i])) return false;
  }
  return a.size() < b.size();
}

Value compare_vectors(BinaryOp op, const Value& left, const Value& right,
                      Reason& reason) {
  // a > b is b < a; a <= b is not (b < a).
  const bool is_swapped =
      op == BinaryOp::kGreater || op == BinaryOp::kLessEqual;
  const bool is_negated =
      op == BinaryOp::kLessEqual || op == BinaryOp::kGreaterEqual;
  const std::optional<bool> less =
      is_less_vector((is_swapped ? right : left).as_vector(),
                     (is_swapped ? left : right).as_vector(), reason);
  if (!less) return Value();
  return Value(*less != is_negated);
}

template <typename T>
bool compare_plain(BinaryOp op, const T& a, const T& b) {
  switch (op) {
    case BinaryOp::kLess:
      return a < b;
    case BinaryOp::kLessEqual:
      return a <= b;
    case BinaryOp::kGreater:
      return a > b;
    default:
      return a >= b;
  }
}

}  // namespace

Value compare(BinaryOp op, const Value& left, const Value& right,
              Reason& reason) {
  const bool both_undef = left.is_undef() && right.is_undef();
  if (left.type() != right.type() && !both_undef) {
    return undefined(op, left, right, reason);
  }
  switch (left.type()) {
    case Type::kBool:
      return Value(compare_plain(op, left.as_bool(), right.as_bool()));
    case Type::kNumber:
      return Value(compare_plain(op, left.as_number(), right.as_number()));
    case Type::kString:
      return Value(compare_plain(op, left.as_string(), right.as_string()));
    case Type::kVector:
      return compare_vectors(op, left, right, reason);
    case Type::kRange: {
      const bool or_equal =
          op == BinaryOp::kLessEqual || op == BinaryOp::kGreaterEqual;
      const bool is_less_op =
          op == BinaryOp::kLess || op == BinaryOp::kLessEqual;
      const Range& a = (is_less_op ? left : right).as_range();
      const Range& b = (is_less_op ? right : left).as_range();
      return Value(is_less_range(a, b, or_equal));
    }
    default:
      return undefined_because(reason, "operation undefined ({} {} {})",
                               type_name(left.type()), ast::symbol(op),
                               type_name(right.type()));
  }
}

bool are_equal(const Value& left, const Value& right) {
  if (left.is_undef() && right.is_undef()) return true;
  if (left.type() != right.type()) return false;
  switch (left.type()) {
    case Type::kBool:
      return left.as_bool() == right.as_bool();
    case Type::kNumber:
      return left.as_number() == right.as_number();
    case Type::kString:
      return left.as_string() == right.as_string();
    case Type::kVector: {
      const std::span<const Value> a = left.as_vector();
      const std::span<const Value> b = right.as_vector();
      if (a.size() != b.size()) return false;
      for (std::size_t i = 0; i < a.size(); ++i) {
        if (!are_equal(a[i], b[i])) return false;
      }
      return true;
    }
    case Type::kRange:
      return are_equal_ranges(left.as_range(), right.as_range());
    case Type::kFunction:
      return are_equal_functions(left, right);
    case Type::kObject:
      return are_equal_objects(left, right);
    default:
      return left.is_identical(right);
  }
}

bool is_less(const Value& left, const Value& right) {
  if (left.is_number() && right.is_number()) {
    return left.as_number() < right.as_number();
  }
  Reason unused;
  return compare(BinaryOp::kLess, left, right, unused).is_true();
}

}  // namespace lamina::csg
