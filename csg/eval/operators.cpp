#include "csg/eval/operators.h"

#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "csg/eval/object.h"

namespace lamina::csg {

namespace {

using ast::BinaryOp;

std::string_view symbol(BinaryOp op) {
  switch (op) {
    case BinaryOp::kLess:
      return "<";
    case BinaryOp::kLessEqual:
      return "<=";
    case BinaryOp::kGreater:
      return ">";
    case BinaryOp::kGreaterEqual:
      return ">=";
    case BinaryOp::kBitOr:
      return "|";
    case BinaryOp::kBitAnd:
      return "&";
    case BinaryOp::kShiftLeft:
      return "<<";
    case BinaryOp::kShiftRight:
      return ">>";
    case BinaryOp::kAdd:
      return "+";
    case BinaryOp::kSubtract:
      return "-";
    case BinaryOp::kMultiply:
      return "*";
    case BinaryOp::kDivide:
      return "/";
    case BinaryOp::kModulo:
      return "%";
    case BinaryOp::kPower:
      return "^";
    default:
      return "";
  }
}

Value undefined(BinaryOp op, const Value& left, const Value& right,
                std::string& reason) {
  reason = fmt::format("undefined operation ({} {} {})", type_name(left.type()),
                       symbol(op), type_name(right.type()));
  return Value();
}

// --- Comparison -----------------------------------------------------------

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

Value compare(BinaryOp op, const Value& left, const Value& right,
              std::string& reason);

// Lexicographic; nothing where elements cannot be compared.
std::optional<bool> is_less_vector(std::span<const Value> a,
                                   std::span<const Value> b,
                                   std::string& reason) {
  const std::size_t common = std::min(a.size(), b.size());
  for (std::size_t i = 0; i < common; ++i) {
    const Value less = compare(BinaryOp::kLess, a[i], b[i], reason);
    if (less.is_undef()) {
      reason += fmt::format("\n\tin vector comparison at index {}", i);
      return std::nullopt;
    }
    if (less.is_true()) return true;
    if (is_less(b[i], a[i])) return false;
  }
  return a.size() < b.size();
}

Value compare_vectors(BinaryOp op, const Value& left, const Value& right,
                      std::string& reason) {
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

Value compare(BinaryOp op, const Value& left, const Value& right,
              std::string& reason) {
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
      reason =
          fmt::format("operation undefined ({} {} {})", type_name(left.type()),
                      symbol(op), type_name(right.type()));
      return Value();
  }
}

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

Value add_or_subtract_vectors(BinaryOp op, Value&& left, Value&& right,
                              std::string& reason);

// Inlined for the sake of numbers, the elements of most vectors.
[[gnu::always_inline]] inline Value add_or_subtract(BinaryOp op, Value&& left,
                                                    Value&& right,
                                                    std::string& reason) {
  if (left.is_number() && right.is_number()) {
    return Value(op == BinaryOp::kAdd ? left.as_number() + right.as_number()
                                      : left.as_number() - right.as_number());
  }
  return add_or_subtract_vectors(op, std::move(left), std::move(right), reason);
}

Value add_or_subtract_vectors(BinaryOp op, Value&& left, Value&& right,
                              std::string& reason) {
  if (!left.is_vector() || !right.is_vector()) {
    return undefined(op, left, right, reason);
  }
  const std::span<const Value> a = left.as_vector();
  const std::span<const Value> b = right.as_vector();
  const std::size_t count = std::min(a.size(), b.size());
  std::string unused;
  if (right.own_elements().size() == count) {
    return map_elements(
        std::move(right), count, [&](std::size_t i, Value&& element) {
          return add_or_subtract(op, Value(a[i]), std::move(element), unused);
        });
  }
  return map_elements(
      std::move(left), count, [&](std::size_t i, Value&& element) {
        return add_or_subtract(op, std::move(element), Value(b[i]), unused);
      });
}

Value multiply_any(Value&& left, Value&& right, std::string& reason);

[[gnu::always_inline]] inline Value multiply(Value&& left, Value&& right,
                                             std::string& reason) {
  if (left.is_number() && right.is_number()) {
    return Value(left.as_number() * right.as_number());
  }
  return multiply_any(std::move(left), std::move(right), reason);
}

Value multiply_elements(Value&& vector, const Value& factor) {
  const std::size_t count = vector.as_vector().size();
  std::string unused;
  return map_elements(
      std::move(vector), count, [&](std::size_t, Value&& element) {
        return multiply(std::move(element), Value(factor), unused);
      });
}

Value multiply_matrix_by_vector(std::span<const Value> matrix,
                                std::span<const Value> vector,
                                std::string& reason) {
  VectorBuilder result(matrix.size());
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    const std::span<const Value> row = matrix[i].elements();
    if (!matrix[i].is_vector() || row.size() != vector.size()) {
      reason = fmt::format("Matrix must be rectangular. Problem at row {}", i);
      return Value();
    }
    double sum = 0;
    for (std::size_t j = 0; j < row.size(); ++j) {
      if (!row[j].is_number()) {
        reason = fmt::format(
            "Matrix must contain only numbers. Problem at row {}, col {}", i,
            j);
        return Value();
      }
      if (!vector[j].is_number()) {
        reason = fmt::format(
            "Vector must contain only numbers. Problem at index {}", j);
        return Value();
      }
      sum += row[j].as_number() * vector[j].as_number();
    }
    result.push(Value(sum));
  }
  return result.finish();
}

Value multiply_vector_by_matrix(std::span<const Value> vector,
                                std::span<const Value> matrix,
                                std::string& reason) {
  const std::size_t columns = matrix[0].elements().size();
  VectorBuilder result(columns);
  for (std::size_t i = 0; i < columns; ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < vector.size(); ++j) {
      const std::span<const Value> row = matrix[j].elements();
      if (!matrix[j].is_vector() || row.size() != columns) {
        reason =
            fmt::format("Matrix must be rectangular. Problem at row {}", j);
        return Value();
      }
      if (!vector[j].is_number()) {
        reason = fmt::format(
            "Vector must contain only numbers. Problem at index {}", j);
        return Value();
      }
      if (!row[i].is_number()) {
        reason = fmt::format(
            "Matrix must contain only numbers. Problem at row {}, col {}", j,
            i);
        return Value();
      }
      sum += vector[j].as_number() * row[i].as_number();
    }
    result.push(Value(sum));
  }
  return result.finish();
}

Value multiply_matrices(std::span<const Value> left,
                        std::span<const Value> right, std::string& reason) {
  VectorBuilder result(left.size());
  for (std::size_t i = 0; i < left.size(); ++i) {
    const std::span<const Value> row = left[i].elements();
    if (row.size() != right.size()) {
      reason = fmt::format(
          "matrix*matrix left operand row length does not match right operand "
          "row count ({} != {}) at row {}",
          row.size(), right.size(), i);
      return Value();
    }
    Value product = multiply_vector_by_matrix(row, right, reason);
    if (product.is_undef()) {
      reason += fmt::format("\n\twhile processing left operand at row {}", i);
      return Value();
    }
    result.push(std::move(product));
  }
  return result.finish();
}

Value multiply_vectors(std::span<const Value> a, std::span<const Value> b,
                       std::string& reason) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!a[i].is_number() || !b[i].is_number()) {
      return undefined(BinaryOp::kMultiply, a[i], b[i], reason);
    }
    sum += a[i].as_number() * b[i].as_number();
  }
  return Value(sum);
}

// What a product of two vectors means depends on their first elements.
Value multiply_any_vectors(std::span<const Value> a, std::span<const Value> b,
                           std::string& reason) {
  if (a.empty() || b.empty()) {
    reason = "Multiplication is undefined on empty vectors";
    return Value();
  }
  const Value& first = a[0];
  const Value& second = b[0];
  if (first.is_number() && second.is_number()) {
    if (a.size() == b.size()) return multiply_vectors(a, b, reason);
    reason = fmt::format("vector*vector requires matching lengths ({} != {})",
                         a.size(), b.size());
  } else if (first.is_number() && second.is_vector()) {
    if (a.size() == b.size()) return multiply_vector_by_matrix(a, b, reason);
    reason = fmt::format(
        "vector*matrix requires vector length to match matrix row count ({} "
        "!= {})",
        a.size(), b.size());
  } else if (first.is_vector() && second.is_number()) {
    const std::size_t columns = first.as_vector().size();
    if (columns == b.size()) return multiply_matrix_by_vector(a, b, reason);
    reason = fmt::format(
        "matrix*vector requires matrix column count to match vector length "
        "({} != {})",
        columns, b.size());
  } else if (first.is_vector() && second.is_vector()) {
    const std::size_t columns = first.as_vector().size();
    if (columns == b.size()) return multiply_matrices(a, b, reason);
    reason = fmt::format(
        "matrix*matrix requires left operand column count to match right "
        "operand row count ({} != {})",
        columns, b.size());
  } else {
    reason = fmt::format(
        "undefined vector*vector multiplication where first elements are "
        "types {} and {}",
        type_name(first.type()), type_name(second.type()));
  }
  return Value();
}

Value multiply_any(Value&& left, Value&& right, std::string& reason) {
  if (left.is_vector() && right.is_number()) {
    return multiply_elements(std::move(left), right);
  }
  if (left.is_number() && right.is_vector()) {
    return multiply_elements(std::move(right), left);
  }
  if (left.is_vector() && right.is_vector()) {
    return multiply_any_vectors(left.as_vector(), right.as_vector(), reason);
  }
  return undefined(BinaryOp::kMultiply, left, right, reason);
}

Value divide(Value&& left, Value&& right, std::string& reason) {
  if (left.is_number() && right.is_number()) {
    return Value(left.as_number() / right.as_number());
  }
  std::string unused;
  if (left.is_vector() && right.is_number()) {
    const std::size_t count = left.as_vector().size();
    return map_elements(
        std::move(left), count, [&](std::size_t, Value&& element) {
          return divide(std::move(element), Value(right), unused);
        });
  }
  if (left.is_number() && right.is_vector()) {
    const std::size_t count = right.as_vector().size();
    return map_elements(
        std::move(right), count, [&](std::size_t, Value&& element) {
          return divide(Value(left), std::move(element), unused);
        });
  }
  return undefined(BinaryOp::kDivide, left, right, reason);
}

// --- Bits -------------------------------------------------------------------

// What bitwise operators see: the number cut to an integer of 64 bits in two's
// complement. All that does not fit is the least integer, as x86 converts it.
std::int64_t to_bits(double number) {
  const bool fits = number >= -0x1p63 && number < 0x1p63;
  return fits ? static_cast<std::int64_t>(number)
              : std::numeric_limits<std::int64_t>::min();
}

Value apply_bitwise(BinaryOp op, double left, double right,
                    std::string& reason) {
  const std::int64_t a = to_bits(left);
  const std::int64_t b = to_bits(right);
  const bool is_shift =
      op == BinaryOp::kShiftLeft || op == BinaryOp::kShiftRight;
  if (is_shift && (b < 0 || b >= 64)) {
    reason = b < 0 ? "negative shift" : "shift too large";
    return Value();
  }
  switch (op) {
    case BinaryOp::kBitOr:
      return Value(static_cast<double>(a | b));
    case BinaryOp::kBitAnd:
      return Value(static_cast<double>(a & b));
    case BinaryOp::kShiftLeft:
      return Value(static_cast<double>(a << b));
    default:
      return Value(static_cast<double>(a >> b));
  }
}

Value invert(const Value& value, std::string& reason) {
  if (value.is_number()) {
    return Value(static_cast<double>(~to_bits(value.as_number())));
  }
  reason = fmt::format("undefined operation (~{})", type_name(value.type()));
  return Value();
}

}  // namespace

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
      return left.is_same_object(right);
  }
}

bool is_less(const Value& left, const Value& right) {
  if (left.is_number() && right.is_number()) {
    return left.as_number() < right.as_number();
  }
  std::string unused;
  return compare(BinaryOp::kLess, left, right, unused).is_true();
}

Value apply_binary(BinaryOp op, Value left, Value right, std::string& reason) {
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

Value apply_unary(ast::UnaryOp op, Value value, std::string& reason) {
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

Value negate(Value value, std::string& reason) {
  if (value.is_number()) return Value(-value.as_number());
  if (value.is_vector()) {
    const std::size_t count = value.as_vector().size();
    std::string unused;
    return map_elements(std::move(value), count,
                        [&](std::size_t, Value&& element) {
                          return negate(std::move(element), unused);
                        });
  }
  reason = fmt::format("undefined operation (-{})", type_name(value.type()));
  return Value();
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
