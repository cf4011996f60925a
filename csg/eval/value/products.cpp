// Products of vectors and matrices (see operators.h).

#include "csg/eval/value/operators.h"

namespace lamina::csg {

namespace {

Value multiply_matrix_by_vector(std::span<const Value> matrix,
                                std::span<const Value> vector, Reason& reason) {
  VectorBuilder result(matrix.size());
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    const std::span<const Value> row = matrix[i].elements();
    if (!matrix[i].is_vector() || row.size() != vector.size()) {
      return undefined_because(
          reason, "Matrix must be rectangular. Problem at row {}", i);
    }
    double sum = 0;
    for (std::size_t j = 0; j < row.size(); ++j) {
      if (!row[j].is_number()) {
        return undefined_because(
            reason,
            "Matrix must contain only numbers. Problem at row {}, col {}", i,
            j);
      }
      if (!vector[j].is_number()) {
        return undefined_because(
            reason, "Vector must contain only numbers. Problem at index {}", j);
      }
      sum += row[j].as_number() * vector[j].as_number();
    }
    result.push(Value(sum));
  }
  return result.finish();
}

// The message on a faulty element, which OpenSCAD says twice here.
template <typename... Parts>
Value refuse(Reason& reason, fmt::format_string<Parts...> words,
             Parts&&... parts) {
  undefined_because(reason, words, std::forward<Parts>(parts)...);
  reason.said_before = reason.text;
  return Value();
}

Value multiply_vector_by_matrix(std::span<const Value> vector,
                                std::span<const Value> matrix, Reason& reason) {
  const std::size_t columns = matrix[0].elements().size();
  VectorBuilder result(columns);
  for (std::size_t i = 0; i < columns; ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < vector.size(); ++j) {
      const std::span<const Value> row = matrix[j].elements();
      if (!matrix[j].is_vector() || row.size() != columns) {
        return refuse(reason, "Matrix must be rectangular. Problem at row {}",
                      j);
      }
      if (!vector[j].is_number()) {
        return refuse(
            reason, "Vector must contain only numbers. Problem at index {}", j);
      }
      if (!row[i].is_number()) {
        return refuse(
            reason,
            "Matrix must contain only numbers. Problem at row {}, col {}", j,
            i);
      }
      sum += vector[j].as_number() * row[i].as_number();
    }
    result.push(Value(sum));
  }
  return result.finish();
}

Value multiply_matrices(std::span<const Value> left,
                        std::span<const Value> right, Reason& reason) {
  VectorBuilder result(left.size());
  for (std::size_t i = 0; i < left.size(); ++i) {
    const std::span<const Value> row = left[i].elements();
    if (row.size() != right.size()) {
      return undefined_because(
          reason,
          "matrix*matrix left operand row length does not match right operand "
          "row count ({} != {}) at row {}",
          row.size(), right.size(), i);
    }
    Value product = multiply_vector_by_matrix(row, right, reason);
    if (product.is_undef()) {
      reason.text +=
          fmt::format("\n\twhile processing left operand at row {}", i);
      return Value();
    }
    result.push(std::move(product));
  }
  return result.finish();
}

Value dot_product(std::span<const Value> a, std::span<const Value> b,
                  Reason& reason) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!a[i].is_number() || !b[i].is_number()) {
      return undefined(ast::BinaryOp::kMultiply, a[i], b[i], reason);
    }
    sum += a[i].as_number() * b[i].as_number();
  }
  return Value(sum);
}

}  // namespace

Value multiply_vectors(std::span<const Value> a, std::span<const Value> b,
                       Reason& reason) {
  if (a.empty() || b.empty()) {
    return undefined_because(reason,
                             "Multiplication is undefined on empty vectors");
  }
  const Value& first = a[0];
  const Value& second = b[0];
  if (first.is_number() && second.is_number()) {
    if (a.size() == b.size()) return dot_product(a, b, reason);
    return undefined_because(
        reason, "vector*vector requires matching lengths ({} != {})", a.size(),
        b.size());
  }
  if (first.is_number() && second.is_vector()) {
    if (a.size() == b.size()) return multiply_vector_by_matrix(a, b, reason);
    return undefined_because(reason,
                             "vector*matrix requires vector length to match "
                             "matrix row count ({} != {})",
                             a.size(), b.size());
  }
  if (first.is_vector() && second.is_number()) {
    const std::size_t columns = first.as_vector().size();
    if (columns == b.size()) return multiply_matrix_by_vector(a, b, reason);
    return undefined_because(reason,
                             "matrix*vector requires matrix column count to "
                             "match vector length ({} != {})",
                             columns, b.size());
  }
  if (first.is_vector() && second.is_vector()) {
    const std::size_t columns = first.as_vector().size();
    if (columns == b.size()) return multiply_matrices(a, b, reason);
    return undefined_because(reason,
                             "matrix*matrix requires left operand column count "
                             "to match right operand row count ({} != {})",
                             columns, b.size());
  }
  return undefined_because(reason,
                           "undefined vector*vector multiplication where first "
                           "elements are types {} and {}",
                           type_name(first.type()), type_name(second.type()));
}

}  // namespace lamina::csg
