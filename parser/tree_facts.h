#pragma once
// What a syntax tree shows without being evaluated.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "parser/ast.h"

namespace lamina::ast {

// Whether OpenSCAD calls an expression a literal: numbers, strings, truth
// values, undef, and vectors, ranges and signs of such.
bool is_literal(const Expr& expr);

enum class ValueType : std::uint8_t {
  kAny,  // not known without evaluating the design
  kBool,
  kNumber,
  kString,
  kVector,
  kRange
};

// The type of the value of a literal, or of arithmetic on literals; kAny for
// undef and for whatever names a variable or calls a function.
ValueType type_of(const Expr& expr);

// The number that a literal stands for, its sign included; nothing where it is
// none.
std::optional<double> number_of(const Expr& expr);

// Those of a vector of such; nothing where it is none.
std::optional<std::vector<double>> numbers_of(const Expr& expr);

// The variables that a scope assigns, in the order of their first assignments:
// of each the index of its last assignment, which counts.
std::vector<std::size_t> assignments_that_count(Statements statements);

}  // namespace lamina::ast
