#pragma once
// What can be told of an expression without evaluating it.

#include <cstdint>
#include <optional>

#include "parser/ast.h"

namespace lamina::detail {

// Numbers, strings, truth values, and vectors, ranges and negations of such:
// what OpenSCAD takes for the value of a parameter.
bool is_literal(const ast::Expr& expr);

enum class ValueType : std::uint8_t {
  kBool,
  kNumber,
  kString,
  kVector,
  kRange
};

// The type of the value of a literal, or of arithmetic on literals; none for
// undef and for whatever names a variable or calls a function.
std::optional<ValueType> type_of(const ast::Expr& expr);

}  // namespace lamina::detail
